// Finds the face in pictures of the camera, beside the page: MediaPipe, from this server's own files.

import { FaceLandmarker, type FaceLandmarkerResult } from "@mediapipe/tasks-vision";
import type { Answer, Question } from "./tracking";

// What MediaPipe says of its own inside is of no use in the page; what goes wrong is thrown.
for (const name of ["log", "info", "warn", "error"] as const) console[name] = () => undefined;

let landmarker: FaceLandmarker | null = null;

const tell = (answer: Answer) => self.postMessage(answer);

async function begin(model: ArrayBuffer, loader: string, wasm: string): Promise<void> {
  const files = { wasmLoaderPath: loader, wasmBinaryPath: wasm };
  landmarker = await FaceLandmarker.createFromOptions(files, {
    baseOptions: { modelAssetBuffer: new Uint8Array(model), delegate: "CPU" },
    runningMode: "VIDEO",
    numFaces: 1,
    outputFaceBlendshapes: true,
    outputFacialTransformationMatrixes: true,
  });
  tell({ kind: "ready" });
}

function found({ faceBlendshapes, facialTransformationMatrixes }: FaceLandmarkerResult, time: number): Answer {
  const shapes = faceBlendshapes[0]?.categories;
  const pose = facialTransformationMatrixes[0]?.data;
  if (!shapes || !pose) return { kind: "nobody", time };
  const scores = Object.fromEntries(shapes.map(({ categoryName, score }) => [categoryName, score]));
  delete scores._neutral;
  return { kind: "face", time, scores, pose };
}

self.addEventListener("message", ({ data }: MessageEvent<Question>) => {
  if (data.kind === "begin") {
    begin(data.model, data.loader, data.wasm).catch((error: unknown) =>
      tell({ kind: "failed", message: String((error as Error).message ?? error) }));
    return;
  }
  try {
    tell(found(landmarker!.detectForVideo(data.picture, data.time), data.time));
  } catch (error) {
    tell({ kind: "failed", message: String((error as Error).message) });
  } finally {
    data.picture.close();
  }
});
