// Other programs that write glTF, each in its modes, and what each may cost: sizes of the model.
import { spawnSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { draco, meshopt, quantize, resample, weld } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';

const gltfpack = createRequire(import.meta.url).resolve('gltfpack/cli.js');

const kLossless = 1e-6;
// gltfpack and glTF Transform give positions 14 bits of the largest side, Draco 14 or 11 as asked;
// keys of gltfpack have 12 bits of each quaternion component at 30 Hz.
// Positions of -vpf have 15 bits of mantissa; weights that are quantised have 8 bits.
const kBits14 = 2e-4, kKeys = 2e-2, kMantissa = 3e-5, kWeights = 4e-3;

// An LSS is fitted otherwise where triangles come in another order.
export const modes = [
  { name: 'gltfpack', threeReads: true, pack: [], places: kBits14, poses: kKeys },
  { name: 'gltfpack -noq', threeReads: true, pack: ['-noq'], places: kLossless, poses: kKeys },
  { name: 'gltfpack -noq -kn -km', threeReads: true, pack: ['-noq', '-kn', '-km'], places: kLossless, poses: kKeys, lss: 'fitted otherwise' },
  { name: 'gltfpack -cc', threeReads: true, pack: ['-cc'], places: kBits14, poses: kKeys },
  { name: 'gltfpack -vpf', threeReads: true, pack: ['-vpf'], places: kMantissa, poses: kKeys },
  { name: 'gltfpack -kn', threeReads: true, pack: ['-kn'], places: kBits14, poses: kKeys },
  { name: 'gltfpack -si 0.5', threeReads: true, pack: ['-si', '0.5'], places: kBits14, poses: kKeys, simplifies: true },
  { name: 'gltf-transform quantize', threeReads: true, transform: () => [quantize()], places: kBits14, poses: kWeights },
  { name: 'gltf-transform meshopt', threeReads: true, transform: () => [meshopt({ encoder: MeshoptEncoder })],
    places: kBits14, poses: kWeights },
  { name: 'gltf-transform draco', transform: () => [draco()], places: kBits14, poses: kWeights },
  { name: 'gltf-transform resample', transform: () => [resample()], places: kLossless, poses: 1e-3,
    lss: 'different', sameContacts: true },
  { name: 'gltf-transform weld', transform: () => [weld()], places: kLossless, poses: kLossless,
    lss: 'different', sameContacts: true },
];

async function io() {
  return new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
    'draco3d.decoder': await draco3d.createDecoderModule(),
    'draco3d.encoder': await draco3d.createEncoderModule(),
    'meshopt.decoder': MeshoptDecoder,
    'meshopt.encoder': MeshoptEncoder,
  });
}

/// Empty, or why the writer did not write.
export async function write(mode, from, to) {
  if (mode.pack) {
    const said = spawnSync('node', [gltfpack, '-i', from, '-o', to, ...mode.pack]);
    return said.status === 0 ? '' : String(said.stderr).trim();
  }
  try {
    await MeshoptEncoder.ready;
    await MeshoptDecoder.ready;
    const tool = await io();
    tool.setLogger?.({ debug() {}, info() {}, warn() {}, error() {} });
    const document = await tool.read(from);
    document.setLogger({ debug() {}, info() {}, warn() {}, error() {} });
    await document.transform(...mode.transform());
    await tool.write(to, document);
    return '';
  } catch (error) {
    return String(error.message);
  }
}
