// Renderer, camera and lights. Draws on demand: a frame is asked for where something changed, and
// none is drawn otherwise.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Palette } from "./palette.js";

const fieldOfView = 38;
const maxPixelRatio = 2;
/** Metres; what the camera can come as close as. */
const nearest = 0.02;

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(fieldOfView, 1, nearest, 500);
  readonly controls: OrbitControls;
  private readonly renderer: THREE.WebGLRenderer;
  private isAsked = false;
  private framesDrawn = 0;
  private beforeFrame: () => void = () => {};

  /** Throws where there is no WebGL. */
  constructor(private readonly host: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, stencil: true, powerPreference: "high-performance" });
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

  /** Called before every frame. */
  onFrame(update: () => void): void {
    this.beforeFrame = update;
  }

  paint(palette: Palette): void {
    this.scene.background = new THREE.Color(palette.background);
    this.draw();
  }

  /** Asks for a frame. */
  draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.beforeFrame();
      this.renderer.render(this.scene, this.camera);
      ++this.framesDrawn;
    });
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
    this.renderer.setPixelRatio(Math.min(maxPixelRatio, window.devicePixelRatio));
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
