// How finely moving pictures are drawn: more coarsely where frames take long, so that time and
// words on the page do not wait for them. A picture that stands still is drawn in full.

interface Level {
  /** Of the full resolution. */
  readonly share: number;
  /** Of the scene; null for all of them. */
  readonly maxTriangles: number | null;
}

const levels: readonly Level[] = [
  { share: 1, maxTriangles: null },
  { share: 0.75, maxTriangles: 30000 },
  { share: 0.6, maxTriangles: 12000 },
  { share: 0.5, maxTriangles: 12000 },
  { share: 0.4, maxTriangles: 6000 },
  { share: 0.33, maxTriangles: 6000 },
  { share: 0.3, maxTriangles: 3000 },
];
/** Two frames in a row that take longer are too slow; that many that take less are quick: milliseconds. Thirty a second take 33. */
const slowMs = 30, quickMs = 12;
const slowInARow = 2, quickInARow = 30;

export class Pace {
  private level: number;
  private slow = 0;
  private quick = 0;

  /** Where drawing is known to be slow it begins coarsely. */
  constructor(isSlow = false) {
    this.level = isSlow ? 2 : 0;
  }

  /** Of the full resolution. */
  get share(): number {
    return levels[this.level].share;
  }

  get maxTriangles(): number | null {
    return levels[this.level].maxTriangles;
  }

  get isCoarse(): boolean {
    return this.level > 0;
  }

  /** To be told how long each moving picture took. */
  took(milliseconds: number): void {
    this.slow = milliseconds > slowMs ? this.slow + 1 : 0;
    this.quick = milliseconds < quickMs ? this.quick + 1 : 0;
    if (this.slow >= slowInARow) this.go(1);
    else if (this.quick >= quickInARow) this.go(-1);
  }

  private go(by: 1 | -1): void {
    this.level = Math.min(levels.length - 1, Math.max(0, this.level + by));
    this.slow = this.quick = 0;
  }
}
