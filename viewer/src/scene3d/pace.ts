// How finely moving pictures are drawn: more coarsely where frames take long, so that time and
// words on the page do not wait for them. A picture that stands still is drawn in full.

/** Of the full resolution, by level. From the second on the scene is drawn coarsely, too. */
const shares = [1, 0.75, 0.5, 0.35];
/** Two frames in a row that take longer are too slow; that many that take less are quick: milliseconds. */
const slowMs = 80, quickMs = 25;
const slowInARow = 2, quickInARow = 30;

export class Pace {
  private level: number;
  private slow = 0;
  private quick = 0;

  /** Where drawing is known to be slow it begins coarsely. */
  constructor(isSlow = false) {
    this.level = isSlow ? 1 : 0;
  }

  /** Of the full resolution. */
  get share(): number {
    return shares[this.level];
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
    this.level = Math.min(shares.length - 1, Math.max(0, this.level + by));
    this.slow = this.quick = 0;
  }
}
