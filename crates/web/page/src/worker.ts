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

async function answer({ question, bytes }: Message): Promise<Reply> {
  exports ??= (await WebAssembly.instantiate(module, {})).exports as unknown as Exports;
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
    const message = `the computation stopped: ${error instanceof Error ? error.message : String(error)}`;
    postMessage({ json: JSON.stringify({ error: { message } }), bytes: new Uint8Array() });
  }
};
