// The stage as a film, by the browser's own recorder.

import * as THREE from "three";
import { api } from "./api";
import type { Motion } from "./motion";
import type { Viewer } from "./viewer";

const KINDS = ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm"];
const RATE = 30;
const REST = 250;
// Milliseconds of each piece, how many to wait for, and the bytes of a film without a picture.
const SLICE = 100;
const PATIENCE = 100;
const HEADER = 300;
const BITS = 12_000_000;

// As far as a face, which is open behind, is turned to each side.
const SIDE = 1.25;
export const SECONDS = 6;

type Told = (share: number) => void;

// How a face is turned: whichever, the last picture goes on into the first.
export type Turn = "sides" | "round";

// A film of the face turning from side to side and back, or all the way round: MP4, by the server's
// encoder.
export function turntable(viewer: Viewer, size: readonly [number, number], turn: Turn, tell: Told): Promise<Blob> {
  const from = viewer.azimuth;
  return filmed(viewer, size, SECONDS * RATE, (frame) => {
    const angle = (2 * Math.PI * frame) / (SECONDS * RATE);
    viewer.azimuth = turn === "round" ? angle : SIDE * Math.sin(angle);
  }, tell).finally(() => (viewer.azimuth = from));
}

// A film of the clip, every frame of it, however long each takes to draw.
export function clipFilm(motion: Motion, viewer: Viewer, size: readonly [number, number], tell: Told): Promise<Blob> {
  motion.pause();
  const frames = Math.max(1, Math.round(motion.duration * RATE));
  return filmed(viewer, size, frames, (frame) => motion.seek(frame / RATE), tell);
}

async function filmed(
  viewer: Viewer, [width, height]: readonly [number, number], frames: number,
  pose: (frame: number) => void, tell: Told,
): Promise<Blob> {
  const { id } = await api.beginFilm(width, height, RATE);
  const colour = getComputedStyle(document.documentElement).getPropertyValue("--page").trim();
  viewer.scene.background = new THREE.Color(colour);
  try {
    await viewer.posing(width, height, async (snap) => {
      // The next picture is drawn while the last one is on its way.
      let sent: Promise<unknown> = Promise.resolve();
      for (let frame = 0; frame < frames; frame++) {
        pose(frame);
        const picture = await snap("image/jpeg");
        await sent;
        sent = api.addFrame(id, picture);
        tell(frame / frames);
      }
      await sent;
    });
    return await api.endFilm(id);
  } finally {
    viewer.scene.background = null;
    viewer.draw();
  }
}

// What is drawn while `play` lasts. A film has no transparency: the page's colour is behind it.
export async function recorded(viewer: Viewer, play: () => Promise<void>): Promise<Blob> {
  const kind = globalThis.MediaRecorder && KINDS.find((each) => MediaRecorder.isTypeSupported(each));
  if (!kind) throw new Error("this browser records no films; use pdeface animate, or another browser");
  const colour = getComputedStyle(document.documentElement).getPropertyValue("--page").trim();
  viewer.scene.background = new THREE.Color(colour);
  const recorder = new MediaRecorder(viewer.canvas.captureStream(RATE), {
    mimeType: kind, videoBitsPerSecond: BITS,
  });
  const chunks: Blob[] = [];
  let bytes = 0;
  recorder.addEventListener("dataavailable", ({ data }) => {
    chunks.push(data);
    bytes += data.size;
  });
  const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve));
  try {
    recorder.start(SLICE);
    // A recorder takes its time to begin, and what is played before is lost.
    for (let n = 0; n < PATIENCE && bytes < HEADER; n++) {
      viewer.drawNow();
      await new Promise((resolve) => setTimeout(resolve, SLICE));
    }
    if (bytes < HEADER) throw new Error("the browser recorded nothing; use pdeface animate instead");
    await play();
    // The last frames are still on their way to the recorder.
    await new Promise((resolve) => setTimeout(resolve, REST));
    recorder.stop();
    await stopped;
  } finally {
    if (recorder.state !== "inactive") recorder.stop();
    viewer.scene.background = null;
    viewer.draw();
  }
  return new Blob(chunks, { type: "video/webm" });
}
