// A picture that is drawn with fewer pixels than the screen has is blurred, not blocky: browsers
// that draw by software repeat pixels where a canvas is stretched.

import * as THREE from "three";

export class Upscaler {
  private texture: THREE.FramebufferTexture | null = null;
  private readonly material = new THREE.ShaderMaterial({
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
void main() {
  gl_FragColor = texture2D(picture, at);
}`,
  });
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.Camera();

  constructor() {
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute("position", new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
    const mesh = new THREE.Mesh(triangle, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  /** Spreads the lower left `width` by `height` pixels of the canvas over all of it. */
  spread(renderer: THREE.WebGLRenderer, width: number, height: number): void {
    if (this.texture === null || this.texture.image.width !== width || this.texture.image.height !== height) {
      this.texture?.dispose();
      this.texture = new THREE.FramebufferTexture(width, height);
      this.texture.minFilter = this.texture.magFilter = THREE.LinearFilter;
      this.material.uniforms["picture"].value = this.texture;
    }
    renderer.copyFramebufferToTexture(this.texture);
    const size = renderer.getSize(new THREE.Vector2());
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, size.x, size.y);
    renderer.render(this.scene, this.camera);
  }
}
