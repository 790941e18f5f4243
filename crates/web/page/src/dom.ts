// Elements in one line each, and files that the page gives.

type Attributes = { [name: string]: string | number | boolean | null | undefined | ((event: never) => void) };

/** An element: attributes by name (`onclick` and alike are listeners, false and null are left out), then its children. */
export function h<T extends keyof HTMLElementTagNameMap>(
  tag: T,
  attributes: Attributes = {},
  ...children: (Node | string | null)[]
): HTMLElementTagNameMap[T] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

export function options(choices: readonly (readonly [value: string, label: string])[]): HTMLOptionElement[] {
  return choices.map(([value, label]) => h("option", { value }, label));
}

/** A folded part of the page. */
export function fold(title: string, test: string, ...children: (Node | string | null)[]): HTMLDetailsElement {
  return h("details", { "data-test": test }, h("summary", {}, title), h("div", { class: "folded" }, ...children));
}

export function save(name: string, content: Uint8Array<ArrayBuffer> | string, type = "application/octet-stream"): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

let next = 0;
export const id = (): string => `i${next++}`;

let toasts: HTMLElement | null = null;
/** A short message at the edge of the page, which screen readers read. */
export function toast(message: string): void {
  if (!toasts) document.body.append((toasts = h("div", { class: "toasts", role: "status", "data-test": "toast" })));
  const entry = h("p", {}, message);
  toasts.replaceChildren(entry);
  setTimeout(() => entry.remove(), 5000);
}

export const describe = (error: unknown): string => (error instanceof Error ? error.message : String(error));
