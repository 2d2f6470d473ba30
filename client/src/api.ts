// What is asked of the server. Every error is an Error whose message is a line for the page.

import { unpacked, type Packet } from "./packet";
import type { ClipInfo, ExportRequest, FaceInfo, Opened, PhotoInfo, PhotosInfo, Schema } from "./schema";

export type Weights = Readonly<Record<string, number>>;
// Feature points by name, pixels of a photo.
export type Points = Readonly<Record<string, readonly number[]>>;
export type Join = "smooth" | "patchwise";
// Read through the fitted face, or the paper's five steps.
export type TextureWay = "project" | "warp";
export interface Size {
  readonly rows: number;
  readonly columns: number;
  readonly join?: Join;
}
// A curve, a point on its front half, and the share of a move that it makes.
export type Handle = readonly [number, number, number];
export type { Packet };

// The server does not know the face (any more): it was started anew, and wants it again.
export class UnknownFace extends Error {}

async function ask(path: string, init?: RequestInit): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(path, { ...init, credentials: "same-origin" });
  } catch {
    throw new Error("the server does not answer; start pdeface studio again, your work is kept here");
  }
  if (answer.ok) return answer;
  let message = `the server refused (${answer.status})`;
  try {
    message = ((await answer.json()) as { error: string }).error;
  } catch {
    // Not one of its own refusals.
  }
  throw message.startsWith("the server knows no face") ? new UnknownFace(message) : new Error(message);
}

function post(path: string, value: unknown): Promise<Response> {
  const body = value instanceof Blob ? value : JSON.stringify(value);
  return ask(path, { method: "POST", body });
}

async function json<T>(answer: Promise<Response>): Promise<T> {
  return (await (await answer).json()) as T;
}

async function packet(answer: Promise<Response>): Promise<Packet> {
  return unpacked(await (await answer).arrayBuffer());
}

const face = (id: string) => `/api/faces/${encodeURIComponent(id)}`;
const photo = (id: string) => `/api/photos/${encodeURIComponent(id)}`;
const query = ({ rows, columns, join = "smooth" }: Size) => `rows=${rows}&columns=${columns}&join=${join}`;

export const api = {
  schema: () => json<Schema>(ask("/api/schema")),
  first: () => json<FaceInfo>(ask("/api/first")),
  known: (id: string) => json<FaceInfo>(ask(face(id))),
  modelUrl: (id: string, size: Size) => `${face(id)}/model.glb?${query(size)}`,
  model: async (id: string, size: Size) =>
    (await ask(`${face(id)}/model.glb?${query(size)}`)).arrayBuffer(),
  columns: (id: string, size: Size) => packet(ask(`${face(id)}/columns?${query(size)}`)),
  evaluate: (id: string, size: Size, states: readonly Weights[]) =>
    packet(post(`${face(id)}/evaluate`, { ...size, states })),
  response: (id: string, size: Size, handles: readonly Handle[], symmetric: boolean) =>
    packet(post(`${face(id)}/response`, { ...size, handles, symmetric })),
  meetings: (id: string, size: Size) => packet(ask(`${face(id)}/meetings?${query(size)}`)),
  edit: (id: string, moves: readonly (readonly number[])[]) =>
    json<FaceInfo>(post(`${face(id)}/edit`, { moves })),
  blend: (id: string, other: string, share: number) =>
    json<FaceInfo>(post(`${face(id)}/blend`, { other, share })),
  save: async (id: string, name: string, weights: Weights) =>
    (await post(`${face(id)}/save`, { name, weights })).blob(),
  export: async (id: string, request: ExportRequest) =>
    (await post(`${face(id)}/export`, request)).blob(),
  open: (file: Blob) => json<Opened>(post("/api/open", file)),
  scan: (id: string) => packet(ask(`/api/scans/${encodeURIComponent(id)}`)),
  distances: (id: string, faceId: string, size: Size, weights: Weights) =>
    packet(post(`/api/scans/${encodeURIComponent(id)}/distances`, { ...size, face: faceId, weights })),
  beginFilm: (width: number, height: number, rate: number) =>
    json<{ id: string }>(post("/api/films", { width, height, rate })),
  addFrame: (id: string, picture: Blob) => post(`/api/films/${encodeURIComponent(id)}`, picture),
  endFilm: async (id: string) => (await post(`/api/films/${encodeURIComponent(id)}/end`, {})).blob(),
  trackerModel: async () => (await ask("/api/tracker/model")).arrayBuffer(),
  clip: (name: string) => json<ClipInfo>(ask(`/api/clips/${encodeURIComponent(name)}`)),
  clipFile: async (clip: ClipInfo) => (await post("/api/clips", clip)).blob(),
  firstPhotos: () => json<PhotosInfo>(ask("/api/photos/first")),
  addPhoto: (file: Blob) => json<{ id: string }>(post("/api/photos", file)),
  person: (photos: readonly string[]) => json<Opened>(post("/api/photos/person", { photos })),
  photoUrl: (id: string) => photo(id),
  texture: async (photos: readonly string[], way: TextureWay, points: Points) =>
    (await post("/api/photos/texture", { photos, way, points })).blob(),
  applyTexture: (faceId: string, photos: readonly string[], way: TextureWay, points: Points) =>
    json<FaceInfo>(post("/api/photos/apply", { face: faceId, photos, way, points })),
  photoMesh: (id: string, points: Points) =>
    json<{ mesh: PhotoInfo["mesh"] }>(post(`${photo(id)}/mesh`, { points })),
  pointsFile: async (id: string, points: Points) =>
    (await post(`${photo(id)}/points`, { points })).blob(),
};
