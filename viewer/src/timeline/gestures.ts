// Mouse and fingers on a canvas, as clicks, drags and zooms.

export interface Gesture {
  click(x: number, y: number): void;
  /** By `dx`, to `x`. */
  drag(dx: number, x: number): void;
  /** Below 1 comes closer; `x` stays where it is. */
  zoom(factor: number, x: number): void;
  hover(x: number, y: number): void;
  leave(): void;
  /** Whether a wheel over this place scrolls what is around the canvas. */
  scrolls(x: number): boolean;
}

/** Less is a click, CSS pixels. */
const slack = 4;
/** A line of a wheel that counts in lines, pixels. */
const linePixels = 16;
/** Of what a wheel's pixels do to a zoom; a pinch on a trackpad comes in smaller ones. */
const wheelGain = 0.002, pinchGain = 0.01;

export class Gestures {
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private hasMoved = false;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly gesture: Gesture,
  ) {
    canvas.addEventListener("pointerdown", (event) => this.down(canvas, event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("pointerleave", () => gesture.leave());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  /** The wheel zooms at the pointer; with shift, or sideways on a trackpad, it moves. */
  private wheel(event: WheelEvent): void {
    const { offsetX, ctrlKey, shiftKey } = event;
    if (this.gesture.scrolls(offsetX) && !ctrlKey) return;
    event.preventDefault();
    const scale = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? linePixels : 1;
    const dx = scale * event.deltaX, dy = scale * event.deltaY;
    if (!ctrlKey && (shiftKey || Math.abs(dx) > Math.abs(dy))) this.gesture.drag(-(dx || dy), offsetX);
    else this.gesture.zoom(Math.exp(dy * (ctrlKey ? pinchGain : wheelGain)), offsetX);
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
    if (other === undefined) this.gesture.drag(dx, event.offsetX);
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
