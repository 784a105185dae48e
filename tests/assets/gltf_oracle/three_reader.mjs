// Reads a glTF by three.js: where its vertices and nodes stand at rest, and its nodes at instants of
// its animations. What is only seen is left out of the file before: it would need a browser.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import * as three from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';

globalThis.self = globalThis;
globalThis.ProgressEvent ??= class extends Event {};

const kGlb = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;

// The JSON, with all its buffers in it.
export function withoutPictures(path) {
  const bytes = readFileSync(path);
  let json, binary;
  if (bytes.readUInt32LE(0) === kGlb) {
    for (let at = 12; at < bytes.length; ) {
      const length = bytes.readUInt32LE(at), type = bytes.readUInt32LE(at + 4);
      const chunk = bytes.subarray(at + 8, at + 8 + length);
      if (type === kJson) json = JSON.parse(chunk);
      else if (type === kBinary) binary ??= chunk;
      at += 8 + length;
    }
  } else {
    json = JSON.parse(bytes);
  }
  for (const buffer of json.buffers ?? []) {
    if (buffer.uri?.startsWith('data:')) continue;
    const data = buffer.uri ? readFileSync(join(dirname(path), decodeURIComponent(buffer.uri))) : binary;
    buffer.uri = `data:application/octet-stream;base64,${data.toString('base64')}`;
  }
  for (const mesh of json.meshes ?? []) for (const part of mesh.primitives) delete part.material;
  for (const what of ['materials', 'textures', 'images', 'samplers', 'cameras']) delete json[what];
  return JSON.stringify(json);
}

function verticesOf(scene) {
  const vertices = [];
  scene.traverse((object) => {
    if (!object.isMesh) return;
    const { index, attributes } = object.geometry;
    const used = index ? new Set(index.array) : Array(attributes.position.count).keys();
    for (const i of used) {
      const p = object.getVertexPosition(i, new three.Vector3()).applyMatrix4(object.matrixWorld);
      vertices.push([p.x, p.y, p.z]);
    }
  });
  return vertices;
}

function nodesOf(scene) {
  const nodes = [];
  scene.traverse((object) => {
    const { elements } = object.matrixWorld;
    nodes.push([object.userData.name ?? object.name, elements[12], elements[13], elements[14]]);
  });
  return nodes;
}

function placesOf(scene) {
  scene.updateMatrixWorld(true);
  scene.traverse((object) => object.skeleton?.update());
  return { nodes: nodesOf(scene), vertices: verticesOf(scene) };
}

/// `times[a]`: the instants of animation a, in seconds.
export async function readByThree(path, times) {
  console.warn = () => {};
  const loader = new GLTFLoader();
  loader.setMeshoptDecoder(MeshoptDecoder);
  const { scene, animations } = await loader.parseAsync(withoutPictures(path), '');
  return { ...placesOf(scene), animations: animations.map((clip, a) => {
    const mixer = new three.AnimationMixer(scene);
    const action = mixer.clipAction(clip);
    action.setLoop(three.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    const instants = (times[a] ?? []).map((time) => {
      mixer.setTime(time);
      return placesOf(scene);
    });
    mixer.stopAllAction();
    mixer.uncacheRoot(scene);
    return instants;
  }) };
}
