'use strict';
// The page around the program: it collects files and options, runs commands in a worker, and shows
// what they write. It computes nothing itself.
const $ = (id) => document.getElementById(id);
const text_of = (bytes) => new TextDecoder().decode(bytes);
const bytes_of = (text) => new TextEncoder().encode(text);

let files = new Map();   // path -> bytes: what was dropped, and what the program wrote
let table = [];          // names of the dropped tables; empty: a dataset folder
let fit = '';            // path of the fit file
let commands = [];       // what was run
let worker = null;

const unpacked = (async () => {
  const packed = Uint8Array.from(atob($('wasm').textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
})();
const worker_address = URL.createObjectURL(new Blob([$('worker').textContent], { type: 'text/javascript' }));

// Runs one command: { status, out, err }. Files that it writes replace ours.
async function run(args) {
  const module = await unpacked;
  const begin = performance.now();
  const out = [], err = [];
  return new Promise((resolve) => {
    const tick = setInterval(() => {
      $('state').textContent = `${((performance.now() - begin) / 1000).toFixed(0)} s ${err.at(-1) ?? ''}`;
    }, 500);
    const end = (status) => {
      clearInterval(tick);
      worker?.terminate();
      worker = null;
      $('stop').hidden = true;
      $('state').textContent = '';
      resolve({ status, out: out.join('\n'), err: err.join('\n'), seconds: (performance.now() - begin) / 1000 });
    };
    worker = new Worker(worker_address);
    worker.onerror = (e) => { err.push('recoil: ' + e.message); end(3); };
    worker.onmessage = ({ data }) => {
      if (data.stream) { (data.stream === 'out' ? out : err).push(data.text); return; }
      for (const [path, bytes] of data.files) files.set(path, bytes);
      end(data.status);
    };
    $('stop').hidden = false;
    $('stop').onclick = () => { err.push('stopped'); end(130); };
    worker.postMessage({ module, files: [...files], args });
  });
}

const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

// Runs a command that the reader may repeat; null if it fails, whose message is then shown.
async function step(args) {
  commands.push('recoil ' + args.map(quoted).join(' '));
  const done = await run(args);
  if (done.status === 0) return done;
  $('error').textContent = done.err || done.out;
  // The line names the option that is wrong; the field of that option is marked.
  for (const id of ['diameter', 'particle', 'surface', 'map', 'format', 'ball']) {
    const wrong = done.err.includes('--' + id);
    $(id).setAttribute('aria-invalid', wrong ? 'true' : 'false');
    if (wrong) { $(id).focus(); break; }
  }
  return null;
}

function link(name, parts, type) {
  const a = document.createElement('a');
  a.download = name;
  a.textContent = 'Save ' + name;
  a.href = URL.createObjectURL(new Blob(parts, { type }));
  return a;
}

// A zip file without compression (PKWARE, .ZIP File Format Specification 6.3).
function zip(entries) {
  const table = Uint32Array.from({ length: 256 }, (_, n) => {
    for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
    return n >>> 0;
  });
  const parts = [], central = [];
  let at = 0;
  for (const [path, bytes] of entries) {
    const name = bytes_of(path);
    let crc = 0xffffffff;
    for (const b of bytes) crc = table[(crc ^ b) & 255] ^ (crc >>> 8);
    const common = new DataView(new ArrayBuffer(26));
    common.setUint16(0, 20, true);
    common.setUint16(2, 0x800, true); // names in UTF-8
    common.setUint16(8, 0x21, true);  // 1 January 1980
    common.setUint32(10, ~crc, true);
    common.setUint32(14, bytes.length, true);
    common.setUint32(18, bytes.length, true);
    common.setUint16(22, name.length, true);
    const own = new DataView(new ArrayBuffer(14));
    own.setUint32(10, at, true);
    parts.push(bytes_of('PK\x03\x04'), common, name, bytes);
    central.push(bytes_of('PK\x01\x02'), new Uint8Array([20, 0]), common, own, name);
    at += 30 + name.length + bytes.length;
  }
  const size = central.reduce((sum, part) => sum + part.byteLength, 0);
  const end = new DataView(new ArrayBuffer(18));
  end.setUint16(4, entries.length, true);
  end.setUint16(6, entries.length, true);
  end.setUint32(8, size, true);
  end.setUint32(12, at, true);
  return [...parts, ...central, bytes_of('PK\x05\x06'), end];
}

function show(page, printed) {
  $('result').hidden = false;
  $('text').textContent = printed;
  $('text').hidden = Boolean(page);
  $('page').hidden = !page;
  if (page) $('page').srcdoc = text_of(files.get(page));
  const offered = [page, page.replace(/\.html$/, '.json'), 'pages/fit.json', fit].filter((path) => path && files.has(path));
  $('save').replaceChildren(
    ...offered.map((path) => link(path.split('/').pop(), [files.get(path)], 'application/octet-stream')),
    link('recoil.zip', zip([...files]), 'application/zip'));
  $('commands').textContent = commands.join('\n');
  $('diagnose').hidden = !fit;
  $('result').scrollIntoView();
}

const page_of = (folder) =>
  [...files.keys()].find((path) => path.startsWith(folder + '/') && path.endsWith('.html') && !path.endsWith('/index.html')) ?? '';
const words = (text) => text.trim().split(/\s+/).filter(Boolean);
const option = (id) => ($(id).value.trim() ? ['--' + id, $(id).value.trim()] : []);

async function start() {
  $('error').textContent = '';
  commands = [];
  for (const path of [...files.keys()]) if (/^(pages|diagnosis|mine)\//.test(path)) files.delete(path);
  if (table.length) {
    const format = $('format').value;
    const common = ['--format', format, ...(format === 'csv' ? [] : option('ball')), ...option('diameter'),
      ...option('map'), ...words($('more').value)];
    if ($('ball').value && format !== 'csv') {
      const done = await step(['bounce', ...table, ...common]);
      if (done) { fit = ''; show('', done.out + (done.err ? '\n' + done.err : '')); }
      return;
    }
    const measured = common.includes('--provenance') ? [] : ['--provenance', 'measured'];
    if (!await step(['import', ...table, '--into', 'mine', ...common, ...option('particle'), ...option('surface'), ...measured])) return;
    fit = 'mine/fit.toml';
  }
  const done = await step(['fit', fit, '--out', 'pages', '--replicates', $('replicates').value]);
  if (!done) return;
  show(page_of('pages'), done.out);
  document.body.dataset.seconds = done.seconds;
}

async function diagnose() {
  $('error').textContent = '';
  const done = await step(['diagnose', fit, '--out', 'diagnosis']);
  if (done) show(page_of('diagnosis'), done.out);
}

// The dropped files: a dataset with a fit file, a dataset without one, or tables.
function take(found) {
  files = found;
  const names = [...files.keys()];
  const data = names.find((name) => name.endsWith('datapackage.json'));
  fit = names.find((name) => name.endsWith('.toml') && !name.endsWith('recipe.toml')) ?? '';
  table = data ? [] : names;
  if (data && !fit) {
    const folder = data.split('/').slice(0, -1).join('/') || '.';
    fit = 'fit.toml';
    files.set(fit, bytes_of(`dataset = "${folder}"\n`));
  }
  $('shown').hidden = $('go').hidden = false;
  $('asked').hidden = !table.length;
  $('names').textContent = names.join(', ');
  const first = files.get(table[0] ?? names.find((name) => name.endsWith('points.csv')) ?? names[0]);
  const start = text_of(first.slice(0, 2000));
  $('preview').hidden = /[\0\ufffd]/.test(start);
  $('preview').textContent = start.split('\n').slice(0, 6).join('\n');
  if (/^(RIFF|fLaC|OggS)/.test(start)) $('format').value = 'recording';
}

async function entries_of(entry, found) {
  if (entry.isFile) {
    const file = await new Promise((resolve, reject) => entry.file(resolve, reject));
    found.set(entry.fullPath.replace(/^\//, ''), new Uint8Array(await file.arrayBuffer()));
    return;
  }
  const reader = entry.createReader();
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (!some.length) return;
    for (const one of some) await entries_of(one, found);
  }
}

const examples = JSON.parse($('examples').textContent);
for (const name of Object.keys(examples)) $('example').add(new Option(name));
$('example').onchange = () => {
  const chosen = examples[$('example').value];
  if (chosen) take(new Map(Object.entries(chosen).map(([path, text]) => [path, bytes_of(text)])));
};
$('choose').onchange = async () => {
  const found = new Map();
  for (const file of $('choose').files) found.set(file.name, new Uint8Array(await file.arrayBuffer()));
  if (found.size) take(found);
};
document.ondragover = (e) => { e.preventDefault(); $('drop').classList.add('over'); };
document.ondragleave = () => $('drop').classList.remove('over');
document.ondrop = async (e) => {
  e.preventDefault();
  $('drop').classList.remove('over');
  const found = new Map();
  for (const entry of [...e.dataTransfer.items].map((item) => item.webkitGetAsEntry()).filter(Boolean)) {
    await entries_of(entry, found);
  }
  if (found.size) take(found);
};
$('format').onchange = () => { $('ball-row').hidden = $('format').value === 'csv'; };
$('format').onchange();
async function busy(work) {
  for (const id of ['start', 'diagnose']) $(id).disabled = true;
  try { await work(); } finally { for (const id of ['start', 'diagnose']) $(id).disabled = false; }
}
$('form').onsubmit = (e) => { e.preventDefault(); busy(start); };
$('diagnose').onclick = () => busy(diagnose);
busy(async () => {
  const list = await run(['materials']);
  for (const line of list.out.split('\n')) {
    const name = /^([a-z][\w-]*) +[\d-]/.exec(line);
    if (name) $('materials').append(new Option(name[1]));
  }
});
