// Mouse and fingers on a canvas, as clicks, drags and zooms.

export interface Gesture {
  click(x: number, y: number): void;
  drag(dx: number): void;
  /** Below 1 comes closer; `x` stays where it is. */
  zoom(factor: number, x: number): void;
  hover(x: number, y: number): void;
}

/** Less is a click, CSS pixels. */
const slack = 4;

export class Gestures {
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private hasMoved = false;

  /** Where the wheel is not taken without ctrl, it scrolls the page. */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly gesture: Gesture,
    takesWheel: boolean,
  ) {
    canvas.addEventListener("pointerdown", (event) => this.down(canvas, event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("wheel", (event) => {
      if (!takesWheel && !event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      gesture.zoom(Math.exp(event.deltaY * 0.002), event.offsetX);
    }, { passive: false });
  }

  private down(canvas: HTMLCanvasElement, event: PointerEvent): void {
    canvas.setPointerCapture(event.pointerId);
    if (this.pointers.size === 0) this.hasMoved = false;
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  }

  private move(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (before === undefined) return this.gesture.hover(event.offsetX, event.offsetY);
    const dx = event.offsetX - before.x;
    if (!this.hasMoved && Math.abs(dx) < slack) return;
    this.hasMoved = true;
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other === undefined) this.gesture.drag(dx);
    else this.pinch(before.x, event.offsetX, other.x);
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  }

  private pinch(before: number, now: number, other: number): void {
    const apart = Math.max(10, Math.abs(now - other));
    this.gesture.zoom(Math.max(10, Math.abs(before - other)) / apart, (now + other) / 2);
  }

  private up(event: PointerEvent): void {
    const wasDown = this.pointers.delete(event.pointerId);
    if (wasDown && !this.hasMoved) this.gesture.click(event.offsetX, event.offsetY);
  }
}
