// Our reader of VRM avatars against pixiv's three-vrm: which node is which part of the body and where
// it stands, and the spheres and capsules of spring bones' colliders.
//
//   node vrm_oracle.mjs READ_MODEL FILE...
//
// READ_MODEL: the program of read_model.cpp. Prints a line for every file that differs or that one of
// both refuses, and a count; exit code 1 where something differs.
import { spawnSync } from 'node:child_process';
import { basename } from 'node:path';
import * as three from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { VRMHumanBoneName, VRMHumanoidLoaderPlugin, VRMSpringBoneLoaderPlugin } from '@pixiv/three-vrm';
import { distance, farthestLss } from './distances.mjs';
import { withoutPictures } from './three_reader.mjs';

// Metres. three.js computes in floats' matrices of doubles; the files hold floats.
const kAllowed = 1e-5;

const [program, ...files] = process.argv.slice(2);
console.warn = () => {};

async function readByThreeVrm(file) {
  const loader = new GLTFLoader();
  // It makes helpers only where it is told to, and needs no pictures.
  loader.register((parser) => new VRMHumanoidLoaderPlugin(parser));
  loader.register((parser) => new VRMSpringBoneLoaderPlugin(parser));
  const { scene, userData } = await loader.parseAsync(withoutPictures(file), '');
  scene.updateMatrixWorld(true);
  const bones = new Map();
  for (const name of Object.values(VRMHumanBoneName)) {
    const node = userData.vrmHumanoid?.getRawBoneNode(name);
    if (node) bones.set(name, new three.Vector3().setFromMatrixPosition(node.matrixWorld).toArray());
  }
  const colliders = [];
  let isScaled = false;
  scene.traverse((object) => {
    const shape = object.shape;
    if (!object.colliderMatrix || shape.inside || shape.type === 'plane') return;
    const world = (p) => p.clone().applyMatrix4(object.matrixWorld).toArray();
    const size = new three.Vector3().setFromMatrixScale(object.matrixWorld);
    isScaled ||= size.distanceTo(new three.Vector3(1, 1, 1)) > 1e-6;
    colliders.push([...world(shape.offset), ...world(shape.tail ?? shape.offset), shape.radius]);
  });
  return { bones, colliders, isScaled };
}

function readByUs(file) {
  const said = spawnSync(program, [file], { maxBuffer: 2 ** 30 });
  if (said.status !== 0) return { error: `${program} ended with ${said.status ?? said.signal}` };
  return JSON.parse(said.stdout);
}

const withoutRadius = (lss) => lss.map((one) => [...one.slice(0, 6), 0]);

function differences(ours, theirs) {
  const found = [];
  const names = new Set(Object.values(VRMHumanBoneName));
  const own = new Map(ours.nodes.filter(([name]) => names.has(name)).map(([name, ...p]) => [name, p]));
  for (const [name, place] of theirs.bones) {
    if (!own.has(name)) found.push(`${name} is missing`);
    else if (!(distance(own.get(name), place) <= kAllowed)) found.push(`${name} is elsewhere`);
  }
  for (const name of own.keys()) if (!theirs.bones.has(name)) found.push(`${name} is too many`);
  // three-vrm leaves a radius as it is where nodes scale; we scale it with them.
  const [a, b] = theirs.isScaled ? [withoutRadius(ours.stated), withoutRadius(theirs.colliders)]
    : [ours.stated, theirs.colliders];
  const off = Math.max(farthestLss(a, b), farthestLss(b, a));
  if (!(off <= kAllowed)) {
    found.push(`${a.length} colliders, theirs are ${b.length}, off by ${off}`);
  }
  return found;
}

const told = { alike: 0, different: 0, refused: 0, 'refused by three-vrm': 0 };
let bones = 0, colliders = 0;
for (const file of files) {
  const ours = readByUs(file);
  const theirs = await readByThreeVrm(file).catch((reason) => ({ error: reason.message }));
  const found = ours.error || theirs.error ? [] : differences(ours, theirs);
  const verdict = ours.error ? 'refused' : theirs.error ? 'refused by three-vrm'
    : found.length > 0 ? 'different' : 'alike';
  told[verdict] += 1;
  if (verdict === 'alike') {
    bones += theirs.bones.size;
    colliders += theirs.colliders.length;
  } else {
    console.log(`${verdict}: ${basename(file)}: ${ours.error ?? theirs.error ?? found.slice(0, 3).join('; ')}`);
  }
}
console.log(Object.entries(told).map(([verdict, count]) => `${count} ${verdict}`).join(', ') +
  `; ${bones} bones and ${colliders} colliders compared`);
process.exitCode = told.different > 0 || told.alike === 0 ? 1 : 0;
