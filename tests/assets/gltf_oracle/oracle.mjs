// Our reader of glTF against three.js' GLTFLoader, and against gltfpack and glTF Transform as writers
// in all their modes: what they write of a model is read like the model itself.
//
//   node oracle.mjs READ_MODEL FORETOUCH EXAMPLES [--record FILE] [--only WORD] FILE...
//
// READ_MODEL: the program of read_model.cpp. FORETOUCH and EXAMPLES: the program and the folder of its
// example, for replays of what moves. Prints a line for every reading that differs, and a table;
// exit code 1 where something differs.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { distance, farthestLss } from './distances.mjs';
import { readByThree } from './three_reader.mjs';
import { modes, write } from './writers.mjs';

const options = { record: '', only: '' };
const files = [];
const [program, foretouch, examples, ...rest] = process.argv.slice(2);
while (rest.length > 0) {
  const word = rest.shift();
  if (word === '--record' || word === '--only') options[word.slice(2)] = rest.shift();
  else files.push(word);
}

const folder = mkdtempSync(join(tmpdir(), 'gltf-oracle-'));
process.on('exit', () => rmSync(folder, { recursive: true }));

function readByUs(file, durations = []) {
  const said = spawnSync(program, [file, ...durations.map(String)], { maxBuffer: 2 ** 30 });
  if (said.status !== 0) return { error: `${program} ended with ${said.status ?? said.signal}` };
  return JSON.parse(said.stdout);
}

function sizeOf(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const p of points) {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  }
  return points.length === 0 ? 0 : distance(low, high);
}

// How far points of `a` are from the nearest of `b`, at most: by a scan along a line that no wall of a
// room is square to.
const along = (p) => 0.5377 * p[0] + 0.6119 * p[1] + 0.58 * p[2];
function farthest(a, b) {
  if (a.length === 0) return 0;
  if (b.length === 0) return Infinity;
  const sorted = b.map((p) => [along(p), p]).sort((p, q) => p[0] - q[0]);
  let worst = 0;
  for (const p of a) {
    const at = along(p);
    let low = 0, high = sorted.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (sorted[middle][0] < at) low = middle + 1;
      else high = middle;
    }
    let best = Infinity;
    for (let i = low; i < sorted.length && sorted[i][0] - at < best; ++i) {
      best = Math.min(best, distance(sorted[i][1], p));
    }
    for (let i = low - 1; i >= 0 && at - sorted[i][0] < best; --i) {
      best = Math.min(best, distance(sorted[i][1], p));
    }
    worst = Math.max(worst, best);
  }
  return worst;
}

const bothWays = (a, b) => Math.max(farthest(a, b), farthest(b, a));

// Of names that occur once on both sides.
function farthestNamed(ours, theirs) {
  const once = (entries) => {
    const found = new Map();
    for (const [name, ...p] of entries) found.set(name, found.has(name) ? null : p);
    return found;
  };
  const other = once(theirs);
  let worst = 0;
  for (const [name, p] of once(ours)) {
    const q = other.get(name);
    // nodes[N] is our name for what the file does not name.
    if (name === '' || name.startsWith('nodes[') || !p || !q) continue;
    worst = Math.max(worst, distance(p, q));
  }
  return worst;
}

const places = (named) => named.map(([, ...p]) => p);

const told = { replays: 0, contacts: 0, scaled: new Set() };
const rows = [];
function judge(reader, file, verdict, why) {
  rows.push({ reader, verdict });
  if (verdict !== 'alike') console.log(`${verdict}: ${basename(file)}, ${reader}: ${why}`);
}

// Every fault, with how far it is off in sizes of the model.
class Faults {
  list = [];
  hold(what, found, allowed) {
    if (!(found <= allowed)) this.list.push(`${what} is off by ${found.toPrecision(3)}, allowed ${allowed}`);
  }
}

function verdictOf(faults) {
  return [faults.list.length === 0 ? 'alike' : 'different', faults.list.slice(0, 3).join('; ')];
}

// float has 24 bits; a chain of joints adds up a few of their roundings, and three.js computes in it.
const kLossless = 1e-6, kMoved = 1e-5;

// Of a reading of ours and three.js' of the same file.
async function comparedWithThree(file, ours) {
  const theirs = await readByThree(file, ours.animations.map((a) => (a.instants ?? [])
    .map((_, i) => (i === 0 ? 0 : (a.duration * i) / (a.instants.length - 1)))));
  const faults = new Faults();
  const size = sizeOf(ours.vertices) || sizeOf(places(ours.nodes));
  faults.hold('a vertex', bothWays(ours.vertices, theirs.vertices) / size, kLossless);
  faults.hold('a node', farthestNamed(ours.nodes, theirs.nodes) / size, kLossless);
  faults.hold('the place of a node', farthest(places(ours.nodes), places(theirs.nodes)) / size, kLossless);
  ours.animations.forEach((animation, a) => {
    animation.instants?.forEach((instant, i) => {
      const other = theirs.animations[a]?.[i];
      if (!other) return;
      const at = `animation ${a}, instant ${i}`;
      faults.hold(`${at}: a joint`, farthestNamed(instant.joints, other.nodes) / size, kMoved);
      faults.hold(`${at}: the place of a joint`,
        farthest(places(instant.joints), places(other.nodes)) / size, kMoved);
      // A link is rigid: a scale that changes moves its vertices in three.js alone.
      if (animation.changes_scale) {
        told.scaled.add(`${file} ${a}`);
        return;
      }
      faults.hold(`${at}: a vertex`, bothWays(instant.vertices ?? [], other.vertices) / size, kMoved);
    });
  });
  if (ours.animations.length !== theirs.animations.length) faults.list.push('animations are missing');
  return faults;
}

// The steps' contacts by triangles, in the example's room; nothing of what has no clip.
function contactsOf(file) {
  const avatar = join(folder, 'a.avatar.json'), results = join(folder, 'r.jsonl');
  const of = (...words) => spawnSync(foretouch, words).status === 0;
  if (!of('avatar', 'mesh', file, '--output', avatar)) return [];
  if (!of('replay', '--scene', join(examples, 'room.obj'), '--avatar', avatar, '--motion', file,
    '--rate', '10', '--fidelity', 'exact', '--output', results)) return [];
  return readFileSync(results, 'utf8').split('\n').flatMap((line) => line === '' ? []
    : (JSON.parse(line).contacts ?? []));
}

function compareContacts(mode, ours, file, written, faults) {
  ours.contacts ??= contactsOf(file);
  const contacts = contactsOf(written);
  told.replays += 1;
  told.contacts += ours.contacts.length;
  if (contacts.length !== ours.contacts.length) {
    faults.list.push(`${contacts.length} contacts for ${ours.contacts.length}`);
    return;
  }
  contacts.forEach((contact, i) => {
    const original = ours.contacts[i];
    if (contact.link !== original.link) faults.list.push(`contact ${i}: another link`);
    faults.hold(`contact ${i}: its time in seconds`, Math.abs(contact.time - original.time), mode.poses);
  });
}

async function againstWriters(file, ours) {
  const size = sizeOf(ours.vertices) || sizeOf(places(ours.nodes));
  for (const mode of modes) {
    if (!mode.name.includes(options.only)) continue;
    const written = join(folder, 'written.glb');
    const fault = await write(mode, file, written);
    if (fault !== '') {
      judge(mode.name, file, 'not written', fault);
      continue;
    }
    const read = readByUs(written, ours.animations.map((a) => a.duration));
    if (read.error) {
      judge(mode.name, file, 'refused', read.error);
      continue;
    }
    const faults = new Faults();
    faults.hold('a vertex', farthest(read.vertices, ours.vertices) / size, mode.places);
    if (mode.simplifies) {
      if (read.vertices.length > ours.vertices.length) faults.list.push('more vertices');
    } else {
      faults.hold('a vertex of the original', farthest(ours.vertices, read.vertices) / size, mode.places);
      compareMotion(mode, ours, read, size, faults);
    }
    if (mode.sameContacts && ours.animations.length > 0 && !ours.animations.some((a) => a.changes_scale)) {
      compareContacts(mode, ours, file, written, faults);
    }
    let [verdict, why] = verdictOf(faults);
    // What another reader sees as well is the writer's doing.
    if (verdict === 'different' && mode.threeReads &&
        (await comparedWithThree(written, read)).list.length === 0) verdict = 'written otherwise';
    judge(mode.name, file, verdict, why);
    if (mode.lss) {
      const off = farthestLss(ours.lss, read.lss) / (size || 1);
      judge(`${mode.name}: LSS`, file, off <= kLossless ? 'alike' : mode.lss, `off by ${off.toPrecision(3)}`);
    }
  }
}

function compareMotion(mode, ours, read, size, faults) {
  if (ours.animations.length !== read.animations.length) {
    faults.list.push(`${read.animations.length} animations for ${ours.animations.length}`);
  }
  for (const [a, animation] of read.animations.entries()) {
    const original = ours.animations.find(({ name }) => name === animation.name) ?? ours.animations[a];
    const count = Math.min(animation.instants?.length ?? 0, original.instants?.length ?? 0);
    for (let i = 0; i < count; ++i) {
      const [from, to] = [original.instants[i], animation.instants[i]];
      // gltfpack's own nodes, of its quantisation, have no names; vertices show whether those are right.
      faults.hold(`animation ${a}, instant ${i}: a joint`,
        farthestNamed(to.joints, from.joints) / size, mode.poses);
      faults.hold(`animation ${a}, instant ${i}: a vertex`,
        bothWays(to.vertices ?? [], from.vertices ?? []) / size, mode.poses + mode.places);
    }
  }
}

for (const file of files) {
  const ours = readByUs(file);
  if (ours.error) {
    judge('three.js', file, 'refused', ours.error);
    continue;
  }
  judge('three.js', file, ...verdictOf(await comparedWithThree(file, ours)));
  await againstWriters(file, ours);
}

const verdicts = ['alike', 'written otherwise', 'fitted otherwise', 'refused', 'not written', 'different'];
const table = [...new Set(rows.map(({ reader }) => reader))].map((reader) => [
  reader, ...verdicts.map((v) => rows.filter((row) => row.reader === reader && row.verdict === v).length),
]);
for (const row of [['by', ...verdicts], ...table]) {
  console.log(row.map((cell, i) => String(cell).padEnd(i === 0 ? 30 : 19)).join('').trimEnd());
}
console.log(`${files.length} files; ${told.contacts} contacts of ${told.replays} replays compared; ` +
  `${told.scaled.size} animations change scales: of them joints alone are compared with three.js'`);
if (options.record !== '') {
  const keys = verdicts.map((v) => v.replace(' ', '_'));
  const figures = {
    format: 'foretouch-figures', version: 1, title: 'glTF by other readers and writers',
    machine: { description: 'any: nothing is timed' },
    tables: [{
      name: 'readings', title: 'Readings of every model', command: './run gltf-oracle',
      date: new Date().toISOString().slice(0, 10),
      columns: [{ key: 'by', title: 'by' }, ...verdicts.map((title, i) => ({ key: keys[i], title }))],
      rows: table.map(([by, ...counts]) =>
        Object.fromEntries([['by', by], ...counts.map((count, i) => [keys[i], count])])),
    }],
  };
  writeFileSync(options.record, `${JSON.stringify(figures, null, 1)}\n`);
}
process.exitCode = rows.some(({ verdict }) => verdict === 'different') ? 1 : 0;
