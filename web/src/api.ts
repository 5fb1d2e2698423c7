import type { Front, Found, Info, Rules, Simulated, View, ViewHead } from "./types";

async function post(path: string, body: unknown): Promise<Response> {
  const response = await fetch(path, {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body),
  });
  if (response.ok) return response;
  const text = await response.text();
  let message = `${response.status} ${response.statusText}`;
  try { message = JSON.parse(text).error ?? message; } catch { /* not ours: the status says enough */ }
  throw new Error(message);
}

export const info = async (): Promise<Info> => (await post("/api/info", {})).json();
export const setting = async (body: object): Promise<Found> => (await post("/api/setting", body)).json();
export const simulate = async (body: object): Promise<Simulated> => (await post("/api/simulate", body)).json();
export const front = async (body: object): Promise<Front> => (await post("/api/front", body)).json();
export const rules = async (body: object): Promise<Rules> => (await post("/api/rules", body)).json();
export const quantiles = async (body: object): Promise<{ quantiles: number[] }> => (await post("/api/quantiles", body)).json();

/** tools/page_answers.h says how the bytes lie. */
export async function view(body: object): Promise<View> {
  const bytes = await (await post("/api/view", body)).arrayBuffer();
  const length = new DataView(bytes).getUint32(0, true);
  const head: ViewHead = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  const count = head.nx * head.ny, at = 4 + length;
  return { ...head, values: new Float32Array(bytes, at, count), states: new Uint8Array(bytes, at + 4 * count, count) };
}

/** One call at a time; of those asked for meanwhile only the last is made. */
export function latest<A extends unknown[]>(call: (...args: A) => Promise<void>): (...args: A) => void {
  let running = false;
  let next: A | null = null;
  return async (...args: A) => {
    next = args;
    if (running) return;
    running = true;
    try {
      while (next) {
        const now: A = next;
        next = null;
        await call(...now);
      }
    } finally { running = false; }
  };
}
