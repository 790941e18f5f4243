// The exporter, off the main thread: takes a question, gives its answer. A trap ends an instance, so the next question gets a new one.

interface Exports {
  memory: WebAssembly.Memory;
  reserve(length: number): number;
  call(length: number): number;
}

export interface Message {
  module?: WebAssembly.Module;
  question?: { method: string };
  bytes?: Uint8Array<ArrayBuffer>;
}

export interface Reply {
  json: string;
  bytes: Uint8Array<ArrayBuffer>;
}

let module: WebAssembly.Module;
let exports: Exports | null = null;
/** What the module has printed: the words of a panic. */
let printed = "";

/** What the standard library asks of a system: nothing but random numbers and a place for the words of a panic. */
const view = (): DataView => new DataView(exports!.memory.buffer);
const [SUCCESS, NO_FILE] = [0, 8];
const system: { [name: string]: (...given: number[]) => number } = {
  random_get(at = 0, length = 0) {
    crypto.getRandomValues(new Uint8Array(exports!.memory.buffer, at, length));
    return SUCCESS;
  },
  environ_sizes_get(count = 0, size = 0) {
    view().setUint32(count, 0, true);
    view().setUint32(size, 0, true);
    return SUCCESS;
  },
  environ_get: () => SUCCESS,
  fd_write(_file = 0, parts = 0, count = 0, done = 0) {
    let total = 0;
    for (let part = parts; part < parts + 8 * count; part += 8) {
      const [at, length] = [view().getUint32(part, true), view().getUint32(part + 4, true)];
      printed += new TextDecoder().decode(new Uint8Array(exports!.memory.buffer, at, length));
      total += length;
    }
    view().setUint32(done, total, true);
    return SUCCESS;
  },
};

/** All imports of the module; what isn't above has no file to work on. */
function imports(): WebAssembly.Imports {
  const all: { [from: string]: { [name: string]: WebAssembly.ImportValue } } = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (all[from] ??= {})[name] = system[name] ?? (() => NO_FILE);
  return all;
}

async function answer({ question, bytes }: Message): Promise<Reply> {
  exports ??= (await WebAssembly.instantiate(module, imports())).exports as unknown as Exports;
  const json = new TextEncoder().encode(JSON.stringify(question));
  const length = bytes ? json.length + 1 + bytes.length : json.length;
  const input = exports.reserve(length);
  const room = new Uint8Array(exports.memory.buffer, input, length);
  room.set(json);
  if (bytes) {
    room[json.length] = 0;
    room.set(bytes, json.length + 1);
  }
  const output = exports.call(length);
  const lengths = new DataView(exports.memory.buffer, output, 8);
  const end = output + 8 + lengths.getUint32(0, true);
  return {
    json: new TextDecoder().decode(new Uint8Array(exports.memory.buffer, output + 8, end - output - 8)),
    bytes: new Uint8Array(exports.memory.buffer.slice(end, end + lengths.getUint32(4, true)) as ArrayBuffer),
  };
}

onmessage = async ({ data }: MessageEvent<Message>): Promise<void> => {
  if (data.module) {
    module = data.module;
    return;
  }
  try {
    postMessage(await answer(data));
  } catch (error) {
    exports = null;
    const message = `the computation stopped: ${printed.trim() || (error instanceof Error ? error.message : String(error))}`;
    printed = "";
    postMessage({ json: JSON.stringify({ error: { message } }), bytes: new Uint8Array() });
  }
};
