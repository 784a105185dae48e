// Comma separated values (RFC 4180).

export type Cells = readonly (string | number | boolean | null)[];

/** A text that a spreadsheet would take for a formula is kept from being one: names are untrusted. */
export function csvOf(lines: readonly Cells[]): string {
  return lines.map((cells) => cells.map(cellOf).join(",")).join("\r\n") + "\r\n";
}

function cellOf(value: string | number | boolean | null): string {
  if (typeof value !== "string") return value === null ? "" : String(value);
  const safe = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
