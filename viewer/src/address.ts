// An instant as an address: "#t=6.058&link=LeftFingers&object=railing". Only what is behind the "#"
// belongs to us; it is as untrusted as the document.

export interface Address {
  /** As the page shows it: relative to the clip's zero, seconds. */
  readonly time: number;
  /** "" where none is chosen. */
  readonly link: string;
  readonly object: string;
}

/** Null where the text names no instant. */
export function addressFrom(fragment: string): Address | null {
  const parts = new URLSearchParams(fragment.replace(/^#/, ""));
  const text = parts.get("t") ?? "";
  const time = Number(text);
  if (text.trim() === "" || !Number.isFinite(time)) return null;
  return { time, link: parts.get("link") ?? "", object: parts.get("object") ?? "" };
}

export function fragmentOf({ time, link, object }: Address): string {
  const name = (key: string, value: string): string => (value === "" ? "" : `&${key}=${encodeURIComponent(value)}`);
  // To the microsecond: closer than that no two contacts of a link are.
  return `#t=${Number(time.toFixed(6))}${name("link", link)}${name("object", object)}`;
}
