// What is kept in the browser: the timeline of each window, and the faces in it as .pdeface files.

import type { Step } from "./document";

const PREFIX = "pdeface.studio.1.";
const MOST_WINDOWS = 6;

export interface Session {
  readonly steps: readonly Step[];
  readonly at: number;
  readonly saved: number;
}

// A window keeps its name over a reload, and no other window has it.
function windowName(): string {
  let name = sessionStorage.getItem(`${PREFIX}window`);
  if (!name) {
    name = crypto.randomUUID();
    sessionStorage.setItem(`${PREFIX}window`, name);
  }
  return name;
}

export function keepSession(steps: readonly Step[], at: number): void {
  const session: Session = { steps: steps.slice(-60), at: at - Math.max(0, steps.length - 60), saved: Date.now() };
  try {
    localStorage.setItem(`${PREFIX}session.${windowName()}`, JSON.stringify(session));
    for (const [key] of sessions().slice(MOST_WINDOWS)) localStorage.removeItem(key);
  } catch {
    // Full or forbidden: the work goes on without a net.
  }
}

export function ownSession(): Session | null {
  return read(`${PREFIX}session.${windowName()}`);
}

// What another window left, the latest: one that was closed, or whose browser was.
export function lastSession(): Session | null {
  return sessions()[0]?.[1] ?? null;
}

// Work of the server that this window waits for, by the number of its job.
export interface Begun {
  readonly id: string;
  readonly name: string;
  readonly label: string;
}

export function keepJob(begun: Begun | null): void {
  if (begun) sessionStorage.setItem(`${PREFIX}job`, JSON.stringify(begun));
  else sessionStorage.removeItem(`${PREFIX}job`);
}

export function unfinishedJob(): Begun | null {
  try {
    const value = JSON.parse(sessionStorage.getItem(`${PREFIX}job`) ?? "null") as Begun | null;
    return value && [value.id, value.name, value.label].every((each) => typeof each === "string") ? value : null;
  } catch {
    return null;
  }
}

function sessions(): [string, Session][] {
  return Object.keys(localStorage)
    .filter((key) => key.startsWith(`${PREFIX}session.`))
    .map((key): [string, Session | null] => [key, read(key)])
    .filter((pair): pair is [string, Session] => pair[1] !== null)
    .sort((one, other) => other[1].saved - one[1].saved);
}

// Storage can be edited by anyone and outlives versions: nothing of it is believed unseen.
function read(key: string): Session | null {
  try {
    const value = JSON.parse(localStorage.getItem(key) ?? "null");
    return isSession(value) ? value : null;
  } catch {
    return null;
  }
}

export function isSession(value: unknown): value is Session {
  const { steps, at, saved } = (value ?? {}) as Session;
  return (
    Array.isArray(steps) && steps.length > 0 && Number.isInteger(at) && at >= 0 &&
    at < steps.length && Number.isFinite(saved) && steps.every(isStep)
  );
}

function isStep(value: unknown): boolean {
  const { label, doc } = (value ?? {}) as Step;
  if (typeof label !== "string" || typeof doc !== "object" || doc === null) return false;
  const { face, name, weights } = doc;
  return (
    typeof face === "string" && /^[0-9a-f]{16}$/.test(face) && typeof name === "string" &&
    typeof weights === "object" && weights !== null &&
    Object.values(weights).every((weight) => Number.isFinite(weight))
  );
}

function database(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open("pdeface.studio", 1);
    request.onupgradeneeded = () => request.result.createObjectStore("faces");
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error ?? new Error("no storage"));
  });
}

async function faces<T>(mode: IDBTransactionMode, work: (store: IDBObjectStore) => IDBRequest<T>) {
  const store = (await database()).transaction("faces", mode).objectStore("faces");
  return new Promise<T>((resolve, reject) => {
    const request = work(store);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error ?? new Error("no storage"));
  });
}

export async function keepFace(id: string, file: Blob): Promise<void> {
  await faces("readwrite", (store) => store.put(file, id));
}

export async function keptFace(id: string): Promise<Blob | null> {
  try {
    const kept = await faces("readonly", (store) => store.get(id) as IDBRequest<Blob | undefined>);
    return kept ?? null;
  } catch {
    return null;
  }
}
