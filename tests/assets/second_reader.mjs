// Reads a model with three.js, which shares no code with our importer, and prints as JSON where its
// nodes stand: at rest, and at instants of an animation: its own first one, or that of another file
// (an empty name: its own).
//
//   node second_reader.mjs THREE_FOLDER FILE ANIMATED_FILE SECONDS...
//
// {"rest": {"node": [x, y, z], ...}, "instants": [{"node": [x, y, z], ...}, ...], "unit": centimetres}
// in units of the file, turned to +Y up where the file says Z.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [threeFolder, file, animated, ...seconds] = process.argv.slice(2);
const three = await import(pathToFileURL(`${threeFolder}/build/three.module.js`).href);
const ofThree = (loader) => import(pathToFileURL(`${threeFolder}/examples/jsm/loaders/${loader}.js`).href);
const { FBXLoader } = await ofThree('FBXLoader');

// Pictures and cameras are of no interest, but the loader makes them.
globalThis.document = { createElementNS: () => ({ addEventListener() {}, removeEventListener() {} }) };
globalThis.window = { innerWidth: 1, innerHeight: 1 };
console.warn = console.error = console.log = () => {};

// Needs a parser of XML beside three, which we do not install: npm install @xmldom/xmldom.
async function readCollada(path) {
  const { DOMParser } = await import(
    pathToFileURL(`${threeFolder}/../@xmldom/xmldom/lib/index.js`).href
  );
  globalThis.DOMParser = DOMParser;
  const { ColladaLoader } = await ofThree('ColladaLoader');
  const { scene } = new ColladaLoader().parse(readFileSync(path, 'utf8'), '');
  scene.userData.unitScaleFactor = 100; // it is in metres already
  return scene;
}

async function read(path) {
  if (path.toLowerCase().endsWith('.dae')) return readCollada(path);
  const loader = new FBXLoader();
  loader.trimAnimationClips = true; // time 0 is where the file says that its animation starts
  const bytes = readFileSync(path);
  return loader.parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
}

const root = await read(file);
const { animations } = animated === '' ? root : await read(animated);

function positions() {
  root.updateMatrixWorld(true);
  const found = {};
  root.traverse((node) => {
    const name = node.userData.originalName ?? node.name;
    if (name === '' || name in found) return;
    const { elements } = node.matrixWorld;
    found[name] = [elements[12], elements[13], elements[14]];
  });
  return found;
}

const rest = positions();
const instants = [];
if (seconds.length > 0 && animations.length > 0) {
  const mixer = new three.AnimationMixer(root);
  const action = mixer.clipAction(animations[0]);
  action.setLoop(three.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  for (const time of seconds) {
    mixer.setTime(Number(time));
    instants.push(positions());
  }
}
process.stdout.write(JSON.stringify({ rest, instants, unit: root.userData.unitScaleFactor ?? 1 }));
