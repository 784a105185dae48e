// Renderer and camera. Draws on demand: a frame is asked for where something changed, and
// none is drawn otherwise.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { drawsBySoftware, whenDrawn } from "./gpu.js";
import { Pace } from "./pace.js";
import type { Palette } from "./palette.js";
import { Upscaler } from "./upscaler.js";

const fieldOfView = 38;
const maxPixelRatio = 2;
/** Metres; what the camera can come as close as. */
const nearest = 0.02;
/** After the last change the picture is drawn in full, and where that is not smooth yet once more: milliseconds. */
const stillMs = 300, smoothMs = 1200;

/** How a frame is drawn: as coarsely as it must be, in the screen's pixels, or with more of them. */
enum Finish { Quick, Full, Smooth }

/**
 * A part of the picture, from left to right in [0, 1], and what to do before it is drawn. The middle
 * of the sight is in the middle of every part.
 */
export interface Part {
  readonly from: number;
  readonly to: number;
  prepare(): void;
}

export interface FrameKind {
  readonly isCoarse: boolean;
  /** Of the scene; null for all of them. */
  readonly maxTriangles: number | null;
}

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(fieldOfView, 1, nearest, 500);
  readonly controls: OrbitControls;
  private readonly renderer: THREE.WebGLRenderer;
  private isAsked = false;
  private framesDrawn = 0;
  private beforeFrame: (kind: FrameKind) => readonly Part[] = () => [{ from: 0, to: 1, prepare: () => {} }];

  private readonly isSoftware = drawsBySoftware();
  private readonly pace = new Pace(this.isSoftware);
  private readonly upscaler = new Upscaler();
  /** Of the canvas' pixels, along each side, that the frame is drawn with. */
  private share = 1;
  /** How far the middle of the sight is from the picture's, of its width: in the part drawn last. */
  shift = 0;
  private isBusy = false;
  private isFine = false;
  private stillTimer = 0;

  /** Throws where there is no WebGL. */
  constructor(private readonly host: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: !this.isSoftware, stencil: true, powerPreference: "high-performance" });
    const canvas = this.renderer.domElement;
    canvas.setAttribute("aria-hidden", "true");
    host.prepend(canvas);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.fit()).observe(host);
    this.fit();
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  get frames(): number {
    return this.framesDrawn;
  }

  /** Whether nothing is to be drawn, and what was drawn last was drawn in full. */
  get isAtRest(): boolean {
    return !this.isAsked && !this.isBusy && this.isFine;
  }

  /** Pixels of a frame to one of the page. */
  get pixelRatio(): number {
    return this.renderer.getPixelRatio() * this.share;
  }

  /** Called before every frame, with how coarse it may be; says in which parts it is drawn. */
  onFrame(update: (kind: FrameKind) => readonly Part[]): void {
    this.beforeFrame = update;
  }

  paint(palette: Palette): void {
    this.scene.background = new THREE.Color(palette.background);
    this.draw();
  }

  /** Asks for a frame: drawn at once, or when the one before is done. */
  draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    window.clearTimeout(this.stillTimer);
    if (!this.isBusy) requestAnimationFrame(() => this.render(Finish.Quick));
  }

  private render(finish: Finish): void {
    const start = performance.now();
    this.isAsked = false;
    this.isBusy = true;
    this.share = finish === Finish.Quick ? this.pace.share : 1;
    this.isFine = this.isLast(finish);
    this.setPixelRatio(finish === Finish.Smooth ? this.fullRatio : this.screenRatio);
    this.drawParts(finish !== Finish.Quick);
    ++this.framesDrawn;
    whenDrawn(this.renderer.getContext() as WebGL2RenderingContext, start, (took) => this.drawn(finish, took));
  }

  /** Whether drawing once more would make the picture no better. */
  private isLast(finish: Finish): boolean {
    const isFull = finish !== Finish.Quick || !this.pace.isCoarse;
    return finish === Finish.Smooth || (isFull && this.fullRatio === this.screenRatio);
  }

  private drawParts(isFine: boolean): void {
    const isCoarse = !isFine && this.pace.isCoarse;
    const parts = this.beforeFrame({ isCoarse, maxTriangles: isCoarse ? this.pace.maxTriangles : null });
    const ratio = this.renderer.getPixelRatio();
    // In whole pixels, of which a coarse picture has fewer.
    const width = Math.round(this.share * this.canvas.width), height = Math.round(this.share * this.canvas.height);
    this.renderer.setScissorTest(true);
    for (const { from, to, prepare } of parts) {
      const left = Math.round(from * width), right = Math.round(to * width);
      this.renderer.setScissor(left / ratio, 0, (right - left) / ratio, height / ratio);
      this.shift = (from + to - 1) / 2;
      this.renderer.setViewport(Math.round(this.shift * width) / ratio, 0, width / ratio, height / ratio);
      prepare();
      this.renderer.render(this.scene, this.camera);
    }
    this.renderer.setScissorTest(false);
    if (this.share < 1) this.upscaler.spread(this.renderer, width, height);
  }

  /** What is seen now, drawn in full, as a picture that stays. */
  picture(): HTMLCanvasElement {
    this.share = 1;
    this.setPixelRatio(this.fullRatio);
    this.drawParts(true);
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext("2d")?.drawImage(this.canvas, 0, 0);
    return copy;
  }

  /** For what is drawn aside, before a frame. */
  get drawer(): THREE.WebGLRenderer {
    return this.renderer;
  }

  /** In two goes: a person who walks from touch to touch does not wait for the last, slow one. */
  private drawn(finish: Finish, took: number): void {
    this.isBusy = false;
    if (finish === Finish.Quick) this.pace.took(took);
    if (this.isAsked) return void requestAnimationFrame(() => this.render(Finish.Quick));
    if (this.isFine) return;
    const isCoarse = finish === Finish.Quick && this.pace.isCoarse;
    this.stillTimer = window.setTimeout(() => this.render(isCoarse ? Finish.Full : Finish.Smooth), isCoarse ? stillMs : smoothMs);
  }

  /** The renderer makes its buffers anew even where nothing changes. */
  private setPixelRatio(ratio: number): void {
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
  }

  private get screenRatio(): number {
    return Math.min(maxPixelRatio, window.devicePixelRatio);
  }

  /** Of a picture that stands still. Twice as fine a one is smooth where edges are not smoothed. */
  private get fullRatio(): number {
    return this.isSoftware ? maxPixelRatio : this.screenRatio;
  }

  /** Where a point of the view is on the canvas, in CSS pixels; null behind the camera. */
  screenOf(point: THREE.Vector3): [number, number] | null {
    const p = point.clone().project(this.camera);
    if (p.z > 1) return null;
    const { clientWidth, clientHeight } = this.canvas;
    return [((p.x + 1) / 2 + this.shift) * clientWidth, ((1 - p.y) / 2) * clientHeight];
  }

  /** From the camera through a pixel of the canvas. */
  rayThrough(x: number, y: number): THREE.Ray {
    const { clientWidth, clientHeight } = this.canvas;
    const at = new THREE.Vector2((x / clientWidth - this.shift) * 2 - 1, 1 - (y / clientHeight) * 2);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.camera);
    return caster.ray;
  }

  private fit(): void {
    const width = Math.max(1, this.host.clientWidth), height = Math.max(1, this.host.clientHeight);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
