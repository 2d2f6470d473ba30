// The stage as a film, by the browser's own recorder.

import * as THREE from "three";
import type { Viewer } from "./viewer";

const KINDS = ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm"];
const RATE = 30;
const REST = 250;
// Milliseconds of each piece, how many to wait for, and the bytes of a film without a picture.
const SLICE = 100;
const PATIENCE = 100;
const HEADER = 300;
const BITS = 12_000_000;

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
