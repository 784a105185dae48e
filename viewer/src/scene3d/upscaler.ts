// A picture that is drawn with fewer pixels than the screen has is blurred, not blocky: browsers
// that draw by software repeat pixels where a canvas is stretched.

import * as THREE from "three";

/** The middle of four places around: edges that were drawn as stairs are slopes. Done while there are few pixels. */
const softened = `
  vec2 off = 0.5 / vec2(textureSize(picture, 0)), across = vec2(off.x, -off.y);
  gl_FragColor = 0.25 * (texture2D(picture, at + off) + texture2D(picture, at - off) + texture2D(picture, at + across) + texture2D(picture, at - across));`;
const asItIs = `
  gl_FragColor = texture2D(picture, at);`;

export class Upscaler {
  private texture: THREE.FramebufferTexture | null = null;
  private readonly soften = pass(softened);
  private readonly stretch = pass(asItIs);
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();
  private readonly mesh: THREE.Mesh;

  constructor() {
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute("position", new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
    this.mesh = new THREE.Mesh(triangle, this.stretch);
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
  }

  /** Spreads the lower left `width` by `height` pixels of the canvas over all of it. */
  spread(renderer: THREE.WebGLRenderer, width: number, height: number): void {
    const ratio = renderer.getPixelRatio(), size = renderer.getSize(new THREE.Vector2());
    const texture = this.textureOf(width, height);
    this.draw(renderer, texture, this.soften, width / ratio, height / ratio);
    this.draw(renderer, texture, this.stretch, size.x, size.y);
  }

  /** What is in the corner, drawn anew into a corner of that size. */
  private draw(renderer: THREE.WebGLRenderer, texture: THREE.FramebufferTexture, material: THREE.ShaderMaterial, width: number, height: number): void {
    renderer.copyFramebufferToTexture(texture);
    material.uniforms["picture"].value = texture;
    this.mesh.material = material;
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.setScissorTest(true);
    renderer.render(this.scene, this.camera);
    renderer.setScissorTest(false);
  }

  private textureOf(width: number, height: number): THREE.FramebufferTexture {
    const known = this.texture;
    if (known !== null && known.image.width === width && known.image.height === height) return known;
    known?.dispose();
    const texture = new THREE.FramebufferTexture(width, height);
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    return (this.texture = texture);
  }
}

function pass(sample: string): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    depthTest: false,
    depthWrite: false,
    uniforms: { picture: { value: null } },
    vertexShader: `
varying vec2 at;
void main() {
  at = 0.5 + 0.5 * position.xy;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`,
    fragmentShader: `
varying vec2 at;
uniform sampler2D picture;
void main() {${sample}
}`,
  });
}
