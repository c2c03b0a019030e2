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

// Runs one command: { status, out, err, seconds }. Files that it writes replace ours.
async function run(args) {
  const module = await unpacked;
  const begin = performance.now();
  const out = [], err = [];
  let doing = '';
  return new Promise((resolve) => {
    const tick = setInterval(() => {
      $('state').textContent = `${((performance.now() - begin) / 1000).toFixed(0)} s ${doing}`;
    }, 250);
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
      if (data.stream === 'doing') doing = data.text;
      else if (data.stream) (data.stream === 'out' ? out : err).push(data.text);
      else {
        for (const [path, bytes] of data.files) files.set(path, bytes);
        end(data.status);
      }
    };
    $('stop').hidden = false;
    $('stop').onclick = () => { err.push('stopped'); end(130); };
    worker.postMessage({ module, files: [...files], args });
  });
}

const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

const fields = ['diameter', 'particle', 'surface', 'map', 'format', 'ball'];

// Shows a message at the field whose option it names, or below the buttons.
function show_error(message) {
  let place = $('error');
  for (const id of fields) {
    const wrong = Boolean(message) && place === $('error') && message.includes('--' + id);
    $(id).setAttribute('aria-invalid', String(wrong));
    if (wrong && !$(id + '-row').hidden) place = $(id + '-error');
  }
  for (const id of [...fields.map((id) => id + '-error'), 'error']) $(id).textContent = '';
  place.textContent = message;
  place.previousElementSibling?.focus?.();
}

// Runs a command that the reader may repeat; null if it fails, whose message is then shown.
async function step(args) {
  commands.push('recoil ' + args.map(quoted).join(' '));
  const done = await run(args);
  if (done.status === 0) return done;
  show_error(done.err || done.out);
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

// The results: what the program printed, a picture, and a page.
function show({ text = '', picture = '', page = '' }) {
  $('result').hidden = false;
  $('text').textContent = text;
  $('text').hidden = Boolean(page) || !text;
  $('picture').hidden = !picture || Boolean(page);
  if (picture) $('picture').src = URL.createObjectURL(new Blob([files.get(picture)], { type: 'image/svg+xml' }));
  $('page').hidden = !page;
  if (page) $('page').srcdoc = text_of(files.get(page));
  const offered = [page, picture, ...[...files.keys()].filter((path) => /^pages\/(.*\/)?(fit|diagnosis)\.json$/.test(path)), fit];
  $('save').replaceChildren(
    ...offered.filter((path) => path && files.has(path))
      .map((path) => link(path.split('/').pop(), [files.get(path)], 'application/octet-stream')),
    link('recoil.zip', zip([...files]), 'application/zip'));
  $('commands').textContent = commands.join('\n');
  $('whole').hidden = !fit;
  $('result').scrollIntoView();
}

const words = (text) => text.trim().split(/\s+/).filter(Boolean);
const option = (id) => ($(id).value.trim() && !$(id + '-row').hidden ? ['--' + id, $(id).value.trim()] : []);
const stated = () => [...($('format').value ? ['--format', $('format').value] : []), ...option('map'), ...words($('more').value)];
const no_flights = ['csv', 'webplotdigitizer'];

// Forgets what the program wrote, and starts a new list of commands.
function begin() {
  show_error('');
  commands = [];
  for (const path of [...files.keys()]) if (/^(pages|mine)\//.test(path)) files.delete(path);
}

// Asks the program what the tables hold and which of our fields it needs.
async function look() {
  if (!table.length) return;
  show_error('');
  const done = await run(['import', ...table, ...stated()]);
  const format = /--format (\w+)\)/.exec(done.out)?.[1] ?? $('format').value;
  const missing = /^missing in the file: (.*)$/m.exec(done.out)?.[1] ?? '';
  if (done.status === 0) $('format').value = format;
  else show_error(done.err);
  $('found').textContent = done.out.split('\n').filter((line) => !/^(next|missing)/.test(line)).join('\n');
  const ball = done.status === 0 && !no_flights.includes(format);
  $('ball-row').hidden = !ball;
  if (!ball) $('ball').value = '';
  for (const id of ['diameter', 'particle', 'surface']) {
    $(id + '-row').hidden = done.status !== 0 || Boolean($('ball').value) || !missing.includes('--' + id);
  }
  $('map-row').hidden = done.status === 0 && !$('map').value;
}

// Makes a dataset of the tables; true if there is a fit file.
async function imported() {
  if (!table.length) return Boolean(fit);
  const origin = ['--provenance', 'measured'];
  const more = stated();
  if (!await step(['import', ...table, '--into', 'mine', ...more, ...option('diameter'), ...option('particle'),
    ...option('surface'), ...(more.includes('--provenance') || more.includes('webplotdigitizer') ? [] : origin)])) return false;
  fit = 'mine/fit.toml';
  return true;
}

async function start() {
  begin();
  if (table.length && $('ball').value) {
    fit = '';
    const done = await step(['bounce', ...table, ...stated(), ...option('ball'), '--out', 'pages/figure.svg']);
    if (done) show({ text: done.out, picture: 'pages/figure.svg' });
    return;
  }
  if (!await imported()) return;
  const done = await step(['fit', fit, '--out', 'pages', '--replicates', $('replicates').value]);
  if (!done) return;
  document.body.dataset.seconds = done.seconds;
  show({ text: done.out });
  const drawn = await step(['figure', fit, '--out', 'pages/figure.svg', '--width', '120', '--replicates', $('replicates').value]);
  if (drawn) show({ text: done.out, picture: 'pages/figure.svg' });
}

async function whole() {
  begin();
  if (!await imported()) return;
  const done = await step(['report', fit, '--out', 'pages', '--replicates', $('replicates').value]);
  if (done) show({ page: 'pages/' + fit.split('/').pop().replace(/\.toml$/, '.html') });
}

// The dropped files: a dataset with a fit file, a dataset without one, or tables.
async function take(found) {
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
  $('result').hidden = true;
  $('shown').hidden = $('go').hidden = false;
  $('asked').hidden = !table.length;
  $('names').textContent = names.join(', ');
  $('found').textContent = '';
  for (const id of ['format', 'map', 'ball', 'more']) $(id).value = '';
  const first = files.get(table[0] ?? names.find((name) => name.endsWith('points.csv')) ?? names[0]);
  const beginning = text_of(first.slice(0, 2000));
  $('preview').hidden = /[\0\ufffd]/.test(beginning);
  $('preview').textContent = beginning.split('\n').slice(0, 6).join('\n');
  await busy(look);
}

// Chromium reads the entries of what was dropped on a page from the disk only by their handles.
async function files_of(handle, path, found) {
  if (handle.kind === 'file') found.set(path, new Uint8Array(await (await handle.getFile()).arrayBuffer()));
  else for await (const [name, one] of handle.entries()) await files_of(one, path + '/' + name, found);
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
for (const id of ['choose', 'folder']) {
  $(id).onchange = async () => {
    const found = new Map();
    for (const file of $(id).files) {
      found.set(file.webkitRelativePath || file.name, new Uint8Array(await file.arrayBuffer()));
    }
    if (found.size) take(found);
  };
}
document.ondragover = (e) => { e.preventDefault(); $('drop').classList.add('over'); };
document.ondragleave = () => $('drop').classList.remove('over');
document.ondrop = async (e) => {
  e.preventDefault();
  $('drop').classList.remove('over');
  const found = new Map();
  const items = [...e.dataTransfer.items].filter((item) => item.kind === 'file');
  if (items[0]?.getAsFileSystemHandle) {
    for (const handle of await Promise.all(items.map((item) => item.getAsFileSystemHandle()))) {
      await files_of(handle, handle.name, found);
    }
  } else {
    for (const entry of items.map((item) => item.webkitGetAsEntry())) await entries_of(entry, found);
  }
  if (found.size) take(found);
};
async function busy(work) {
  for (const id of ['start', 'whole']) $(id).disabled = true;
  try { await work(); } finally { for (const id of ['start', 'whole']) $(id).disabled = false; }
}
for (const id of ['format', 'map', 'more', 'ball']) $(id).onchange = () => busy(look);
$('form').onsubmit = (e) => { e.preventDefault(); busy(start); };
$('whole').onclick = () => busy(whole);
busy(async () => {
  const list = await run(['materials']);
  for (const line of list.out.split('\n')) {
    const name = /^([a-z][\w-]*) +[\d-]/.exec(line);
    if (name) $('materials').append(new Option(name[1]));
  }
});
