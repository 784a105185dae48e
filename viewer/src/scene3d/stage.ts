// Renderer, camera and lights. Draws on demand: a frame is asked for where something changed, and
// none is drawn otherwise.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { drawsBySoftware, whenDrawn } from "./gpu.js";
import { Pace } from "./pace.js";
import type { Palette } from "./palette.js";

const fieldOfView = 38;
const maxPixelRatio = 2;
/** Metres; what the camera can come as close as. */
const nearest = 0.02;
/** After the last change the picture is drawn in full, milliseconds. */
const stillMs = 300;

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(fieldOfView, 1, nearest, 500);
  readonly controls: OrbitControls;
  private readonly renderer: THREE.WebGLRenderer;
  private isAsked = false;
  private framesDrawn = 0;
  private beforeFrame: (isCoarse: boolean) => void = () => {};

  private readonly isSoftware = drawsBySoftware();
  private readonly pace = new Pace(this.isSoftware);
  private isBusy = false;
  private isFine = false;
  private stillTimer = 0;

  /** Throws where there is no WebGL. */
  constructor(private readonly host: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: !this.isSoftware, stencil: true, powerPreference: "high-performance" });
    const canvas = this.renderer.domElement;
    canvas.setAttribute("aria-hidden", "true");
    host.prepend(canvas);
    this.scene.add(...lights());
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
    return this.renderer.getPixelRatio();
  }

  /** Called before every frame, with whether it may be a coarse one. */
  onFrame(update: (isCoarse: boolean) => void): void {
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
    if (!this.isBusy) requestAnimationFrame(() => this.render(false));
  }

  private render(isFine: boolean): void {
    const start = performance.now(), isCoarse = !isFine && this.pace.isCoarse;
    this.isAsked = false;
    this.isBusy = true;
    this.isFine = isFine || this.isFullAt(this.pace.share);
    this.setPixelRatio(isFine ? this.fullRatio : this.screenRatio * this.pace.share);
    this.beforeFrame(isCoarse);
    this.renderer.render(this.scene, this.camera);
    ++this.framesDrawn;
    whenDrawn(this.renderer.getContext() as WebGL2RenderingContext, start, (took) => this.drawn(isFine, took));
  }

  private drawn(wasFine: boolean, took: number): void {
    this.isBusy = false;
    if (!wasFine) this.pace.took(took);
    if (this.isAsked) requestAnimationFrame(() => this.render(false));
    else if (!this.isFine) this.stillTimer = window.setTimeout(() => this.render(true), stillMs);
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

  private isFullAt(share: number): boolean {
    return this.screenRatio * share === this.fullRatio;
  }

  /** Where a point of the view is on the canvas, in CSS pixels; null behind the camera. */
  screenOf(point: THREE.Vector3): [number, number] | null {
    const p = point.clone().project(this.camera);
    if (p.z > 1) return null;
    const { clientWidth, clientHeight } = this.canvas;
    return [((p.x + 1) / 2) * clientWidth, ((1 - p.y) / 2) * clientHeight];
  }

  /** From the camera through a pixel of the canvas. */
  rayThrough(x: number, y: number): THREE.Ray {
    const { clientWidth, clientHeight } = this.canvas;
    const at = new THREE.Vector2((x / clientWidth) * 2 - 1, 1 - (y / clientHeight) * 2);
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

function lights(): THREE.Light[] {
  const sky = new THREE.HemisphereLight(0xffffff, 0xc4cad3, 1.9);
  const sun = new THREE.DirectionalLight(0xffffff, 1.6);
  sun.position.set(0.5, 1, 0.35);
  const fill = new THREE.DirectionalLight(0xffffff, 0.5);
  fill.position.set(-0.7, 0.3, -0.5);
  return [sky, sun, fill];
}
