// Jobs of the server, told of over one websocket, which is opened anew whenever it is lost.

import type { JobInfo } from "./schema";

type Watcher = (job: JobInfo) => void;

const AGAIN = 1500;

export class Jobs {
  #watchers = new Map<string, Watcher>();
  // A job may be done before its number is known to the page.
  #latest = new Map<string, JobInfo>();

  // onBack: the server is there again.
  constructor(private onBack: () => void) {
    this.#connect(false);
  }

  watch(job: JobInfo, watcher: Watcher): void {
    this.#watchers.set(job.id, watcher);
    this.#tell(this.#latest.get(job.id) ?? job);
  }

  #connect(again: boolean): void {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/api/jobs`);
    if (again) socket.addEventListener("open", () => this.onBack());
    socket.addEventListener("message", (event) => this.#tell(JSON.parse(event.data as string)));
    socket.addEventListener("close", () => setTimeout(() => this.#connect(true), AGAIN));
  }

  #tell(job: JobInfo): void {
    this.#latest.set(job.id, job);
    this.#watchers.get(job.id)?.(job);
    if (job.state !== "running") this.#watchers.delete(job.id);
  }
}
