// Questions to the exporter. One is under way at a time; of those that wait for the same slot only the newest is asked.
import type { Method, Methods, Mistake, Question } from "./contract";
import type { Message, Reply } from "./worker";
import Live from "./worker?worker&inline";

/** The exporter's own message, with its places if the scene is wrong. */
export class Refusal extends Error {
  constructor(message: string, readonly mistakes: Mistake[] = []) {
    super(message);
  }
}

interface Waiting {
  slot: string | null;
  message: Message;
  settle(reply: Reply | null): void;
}

export interface Answer<M extends Method> {
  ok: Methods[M];
  bytes: Uint8Array<ArrayBuffer>;
}

function parsed<M extends Method>(reply: Reply): Answer<M> {
  const json = JSON.parse(reply.json) as { ok: Methods[M] } | { error: { message: string; mistakes?: Mistake[] } };
  if ("error" in json) throw new Refusal(json.error.message, json.error.mistakes);
  return { ok: json.ok, bytes: reply.bytes };
}

export class Engine {
  readonly #worker = new Live();
  readonly #waiting: Waiting[] = [];
  #current: Waiting | null = null;

  constructor(module: WebAssembly.Module) {
    this.#worker.postMessage({ module } satisfies Message);
    this.#worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      const done = this.#current;
      this.#current = null;
      this.#next();
      const newer = done?.slot && this.#waiting.concat(this.#current ?? []).some(({ slot }) => slot === done.slot);
      done?.settle(newer ? null : data);
    };
  }

  /** The answer to a question; first in line if it is urgent. */
  async ask<M extends Method>(method: M, question: Question = {}, bytes?: Uint8Array<ArrayBuffer>, urgent = false): Promise<Answer<M>> {
    const reply = await this.#put(null, { question: { method, ...question }, bytes }, urgent);
    if (!reply) throw new Error("only questions with a slot are dropped");
    return parsed<M>(reply);
  }

  /** The answer, or null if a newer question of the slot came meanwhile. */
  async newest<M extends Method>(slot: string, method: M, question: Question = {}, urgent = false): Promise<Methods[M] | null> {
    for (const stale of this.#waiting.filter((waiting) => waiting.slot === slot)) {
      this.#waiting.splice(this.#waiting.indexOf(stale), 1);
      stale.settle(null);
    }
    const reply = await this.#put(slot, { question: { method, ...question } }, urgent);
    return reply && parsed<M>(reply).ok;
  }

  end(): void {
    this.#worker.terminate();
  }

  #put(slot: string | null, message: Message, urgent: boolean): Promise<Reply | null> {
    return new Promise((settle) => {
      if (urgent) this.#waiting.unshift({ slot, message, settle });
      else this.#waiting.push({ slot, message, settle });
      this.#next();
    });
  }

  #next(): void {
    if (this.#current) return;
    this.#current = this.#waiting.shift() ?? null;
    if (this.#current) this.#worker.postMessage(this.#current.message);
  }
}

/** The bytes of a data element of the page, which holds them as base64. */
export function embedded(id: string): Uint8Array<ArrayBuffer> {
  const text = document.getElementById(id)?.textContent;
  if (!text) throw new Error(`the page has no part ${id}`);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let index = 0; index < bytes.length; index++) bytes[index] = binary.charCodeAt(index);
  return bytes;
}

/** Bytes through a stream, as a response of a type. */
export function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream, type = ""): Response {
  return new Response(new Blob([bytes]).stream().pipeThrough(stream), { headers: { "content-type": type } });
}

/** The module, compiled while it is unpacked. */
export function compiled(): Promise<WebAssembly.Module> {
  return WebAssembly.compileStreaming(through(embedded("wasm"), new DecompressionStream("deflate-raw"), "application/wasm"));
}
