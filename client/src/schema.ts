// Written by `python -m pdeface.studio.typescript` from src/pdeface/studio/schema.py.

/** A control as the page shows it; ``mirror`` is its namesake on the other side. */
export interface ControlInfo {
  readonly name: string;
  readonly label: string;
  readonly group: string;
  readonly kind: string;
  readonly low: number;
  readonly high: number;
  readonly description: string;
  readonly mirror: string | null;
}

/** Controls that are shown together. */
export interface GroupInfo {
  readonly name: string;
  readonly label: string;
  readonly kind: string;
}

/** Expressions by one name. */
export interface Preset {
  readonly name: string;
  readonly label: string;
  readonly weights: Readonly<Record<string, number>>;
}

/** A uv mesh to choose. */
export interface Density {
  readonly label: string;
  readonly rows: number;
  readonly columns: number;
}

/** All that the page has to know beforehand. */
export interface Schema {
  readonly version: string;
  readonly controls: readonly (ControlInfo)[];
  readonly groups: readonly (GroupInfo)[];
  readonly presets: readonly (Preset)[];
  readonly densities: readonly (Density)[];
  readonly clips: readonly (string)[];
  readonly formats: readonly (string)[];
}

/** A face that the server knows: its curves and texture by ``id``, and what it was set to. ``texture`` differs with the texture, and is empty without one. */
export interface FaceInfo {
  readonly id: string;
  readonly name: string;
  readonly weights: Readonly<Record<string, number>>;
  readonly texture: string;
  readonly curves: number;
  readonly points: number;
}

/** An array in a packet: float32 or int32, little-endian, ``offset`` bytes behind the header. */
export interface ArrayInfo {
  readonly name: string;
  readonly type: string;
  readonly shape: readonly (number)[];
  readonly offset: number;
}

/** What the export dialogue asks for. */
export interface ExportRequest {
  readonly weights: Readonly<Record<string, number>>;
  readonly name: string;
  readonly format: string;
  readonly rows: number;
  readonly columns: number;
  readonly join: string;
  readonly expressions: boolean;
  readonly visemes: boolean;
}

/** A motion: weights by frame, and the head's yaw, pitch and roll, radians. */
export interface ClipInfo {
  readonly name: string;
  readonly times: readonly (number)[];
  readonly names: readonly (string)[];
  readonly weights: readonly (readonly (number)[])[];
  readonly head: readonly (readonly (number)[])[];
  readonly notes: readonly (string)[];
}

/** A feature point of the paper's Fig. 5, pixels from the photo's top-left corner. */
export interface PhotoPoint {
  readonly name: string;
  readonly x: number;
  readonly y: number;
}

/** The camera of a photo, as :class:`pdeface.photo.camera.PhotoCamera` has it. ``rotation`` has the rows of R one after the other. */
export interface CameraInfo {
  readonly rotation: readonly (number)[];
  readonly scale: number;
  readonly centre: readonly (number)[];
  readonly distance: number;
}

/** A photo that the server knows by ``id``: the points in it and the 7 x 7 mesh of Fig. 6. ``camera`` took it, and ``expression`` is what the face does in it. */
export interface PhotoInfo {
  readonly id: string;
  readonly width: number;
  readonly height: number;
  readonly points: readonly (PhotoPoint)[];
  readonly mesh: readonly (readonly (number)[])[];
  readonly camera: CameraInfo;
  readonly expression: Readonly<Record<string, number>>;
  readonly notes: readonly (string)[];
}

/** Photos of one person, the one seen from the front first. */
export interface PhotosInfo {
  readonly photos: readonly (PhotoInfo)[];
}

/** A scan that a face was fitted to, in the frame of the face. ``rms``, ``median`` and ``largest`` are millimetres from the face's front to the scan, ``coverage`` is the share of the front that the scan has. */
export interface ScanInfo {
  readonly id: string;
  readonly vertices: number;
  readonly rms: number;
  readonly median: number;
  readonly largest: number;
  readonly coverage: number;
}

/** How far a job has come: ``state`` is ``"running"``, ``"done"`` or ``"failed"``. ``share`` of its time is over, about. */
export interface JobInfo {
  readonly id: string;
  readonly state: string;
  readonly message: string;
  readonly share: number;
  readonly face: FaceInfo | null;
  readonly photos: readonly (PhotoInfo)[];
  readonly scan: ScanInfo | null;
}

/** What a file turned out to be: one of these. */
export interface Opened {
  readonly face: FaceInfo | null;
  readonly clip: ClipInfo | null;
  readonly job: JobInfo | null;
}
