// Jobs of the server, told of over one websocket, which is opened anew whenever it is lost.

import { unpacked, type Packet } from "./packet";
import type { JobInfo } from "./schema";

type Watcher = (job: JobInfo) => void;
type Onlooker = (packet: Packet) => void;

const AGAIN = 1500;

export class Jobs {
  #watchers = new Map<string, Watcher>();
  #onlookers = new Map<string, Onlooker>();
  // A job may be done before its number is known to the page.
  #latest = new Map<string, JobInfo>();

  // onBack: the server is there again.
  constructor(private onBack: () => void) {
    this.#connect(false);
  }

  // seen: what a job shows of what it has made so far.
  watch(job: JobInfo, watcher: Watcher, seen: Onlooker): void {
    this.#watchers.set(job.id, watcher);
    this.#onlookers.set(job.id, seen);
    this.#tell(this.#latest.get(job.id) ?? job);
  }

  // A job that the page before a reload has begun: if the server knows of it still.
  again(id: string, watcher: Watcher, seen: Onlooker): void {
    this.#watchers.set(id, watcher);
    this.#onlookers.set(id, seen);
    const latest = this.#latest.get(id);
    if (latest) this.#tell(latest);
  }

  #connect(again: boolean): void {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/api/jobs`);
    if (again) socket.addEventListener("open", () => this.onBack());
    socket.binaryType = "arraybuffer";
    socket.addEventListener("message", ({ data }) => {
      if (data instanceof ArrayBuffer) this.#show(unpacked(data));
      else this.#tell(JSON.parse(data as string));
    });
    socket.addEventListener("close", () => setTimeout(() => this.#connect(true), AGAIN));
  }

  #show(packet: Packet): void {
    this.#onlookers.get(packet.header.job as string)?.(packet);
  }

  #tell(job: JobInfo): void {
    this.#latest.set(job.id, job);
    this.#watchers.get(job.id)?.(job);
    if (job.state === "running") return;
    this.#watchers.delete(job.id);
    this.#onlookers.delete(job.id);
  }
}
