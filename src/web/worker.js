// Runs one command of recoil on a memory file system. A fresh program for every command.
function all_files(FS, folder, found) {
  for (const name of FS.readdir(folder)) {
    if (name === '.' || name === '..') continue;
    const path = folder + '/' + name;
    if (FS.isDir(FS.stat(path).mode)) all_files(FS, path, found);
    else found.push([path.slice('/here/'.length), FS.readFile(path)]);
  }
  return found;
}
// Takes a stream byte by byte. A line that is drawn again, of a bar, ends with a carriage return.
function by_lines(line, bar) {
  let bytes = [];
  const text = () => new TextDecoder().decode(new Uint8Array(bytes)).replace('\x1b[K', '').replace(/\[[#.]*\] /, '');
  return (byte) => {
    if (byte === 10 || byte === 13) {
      if (byte === 10) line(text());
      else if (bytes.length) bar(text());
      bytes = [];
    } else if (byte !== null) {
      bytes.push(byte & 255);
    }
  };
}
onmessage = async ({ data }) => {
  const say = (stream) => (text) => postMessage({ stream, text });
  const program = await Recoil({
    noInitialRun: true,
    stdout: by_lines(say('out')),  // not a terminal
    printErr: say('err'),
    preRun: [(m) => Object.assign(m.ENV, { TERM: 'ansi', NO_COLOR: '1', HOME: '/here' })],
    instantiateWasm: (imports, done) => {
      WebAssembly.instantiate(data.module, imports).then((instance) => done(instance));
      return {};
    },
  });
  const { FS } = program;
  FS.mkdirTree('/here');
  for (const [path, bytes] of data.files) {
    FS.mkdirTree('/here/' + path.split('/').slice(0, -1).join('/'));
    FS.writeFile('/here/' + path, bytes);
  }
  const take = by_lines(say('err'), say('doing'));
  FS.streams[2].tty.ops = { put_char: (tty, byte) => take(byte), flush: () => {} };
  FS.chdir('/here');
  let status = 3;
  try {
    status = program.callMain(data.args);
  } catch (e) {
    if (e && e.name === 'ExitStatus') status = e.status;
    else say('err')('recoil: stopped: ' + e);
  }
  postMessage({ status, files: all_files(FS, '/here', []) });
};
