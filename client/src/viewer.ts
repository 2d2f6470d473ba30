// The stage: camera, orbit, lights, and the face. It draws when something has changed.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Head } from "./head";
import { Lights } from "./lights";
import { Display } from "./modes";

export const VIEWS = {
  front: [0, 0.03],
  threeQuarter: [0.52, 0.05],
  profile: [Math.PI / 2, 0.02],
  otherProfile: [-Math.PI / 2, 0.02],
} as const;

export type View = keyof typeof VIEWS;

const FIELD = 22;
const TURN = 0.12;

// Whether the processor draws, which smooth edges and reflections would slow down severalfold.
function isSoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) throw new Error("this browser cannot draw in 3D (WebGL 2); try another, or enable it");
  const named = probe.getExtension("WEBGL_debug_renderer_info");
  const name = probe.getParameter(named?.UNMASKED_RENDERER_WEBGL ?? probe.RENDERER) as string;
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

// A camera that stands where a photo was taken from, in place of the one that orbits.
export interface Stand {
  readonly camera: THREE.PerspectiveCamera;
  resize(width: number, height: number): void;
  fit(): void;
  leave(): void;
}

export class Viewer {
  readonly canvas: HTMLCanvasElement;
  readonly renderer: THREE.WebGLRenderer;
  readonly scene = new THREE.Scene();
  readonly controls: OrbitControls;
  display: Display | null = null;
  head: Head | null = null;
  camera: THREE.PerspectiveCamera | THREE.OrthographicCamera;
  frames = 0;
  // On its way to another view.
  moving = false;
  #perspective = new THREE.PerspectiveCamera(FIELD, 1, 0.02, 10);
  #orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.02, 10);
  #asked = 0;
  #software: boolean;
  #lights: Lights;
  #centre = new THREE.Vector3(0, 0, 0.05);
  #radius = 0.14;
  #animation = 0;
  #stand: Stand | null = null;

  // onLost: the graphics card has given up, so that nothing would be seen.
  constructor(
    private stage: HTMLElement,
    onLost: () => void,
  ) {
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("aria-label", "The face in 3D: drag to turn, wheel to zoom");
    stage.append(this.canvas);
    this.#software = isSoftware();
    const antialias = !this.#software;
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias, alpha: true });
    this.renderer.setPixelRatio(antialias ? Math.min(2, window.devicePixelRatio) : 1);
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.toneMappingExposure = this.#software ? 1.25 : 1.0;
    this.camera = this.#perspective;
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.minDistance = 0.12;
    this.controls.maxDistance = 3;
    this.controls.addEventListener("change", () => this.draw());
    this.#lights = new Lights(this.scene, this.renderer, !this.#software);
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      onLost();
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.#lights.surround();
      this.draw();
    });
    this.renderer.debug.onShaderError = () => onLost();
    new ResizeObserver(() => this.#resize()).observe(stage);
    this.#resize();
  }

  show(head: Head): void {
    const first = this.head === null;
    if (this.head) {
      this.scene.remove(this.head.root);
      this.head.dispose();
    }
    this.head = head;
    this.scene.add(head.root);
    if (this.display) this.display.setHead(head);
    else this.display = new Display(head);
    this.display.resize(this.stage.clientWidth, this.stage.clientHeight);
    const before = this.#radius;
    this.#measure();
    if (first) this.look("threeQuarter", false);
    // Another head, of another size: all of it is shown.
    else if (Math.abs(this.#radius / before - 1) > 0.04 && !this.#stand) this.fit();
    this.draw();
  }

  // Draw with the next frame of the screen, once however often it is asked.
  draw(): void {
    this.#asked ||= requestAnimationFrame(() => this.drawNow());
  }

  drawNow(): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
    this.frames++;
    this.#lights.even = this.display?.wearsPhoto ?? true;
    this.#lights.follow(this.eye);
    this.renderer.render(this.scene, this.eye);
  }

  // The camera through which the face is seen now.
  get eye(): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    return this.#stand?.camera ?? this.camera;
  }

  set stand(stand: Stand | null) {
    this.#stand = stand;
    this.controls.enabled = stand === null;
    this.#resize();
  }

  look(view: View, gently = true): void {
    this.#stand?.leave();
    const [azimuth, height] = VIEWS[view];
    this.#turnTo(azimuth, height, this.#distance(), this.#centre.clone(), gently);
  }

  fit(): void {
    if (this.#stand) {
      this.#stand.fit();
      return;
    }
    const at = this.#spherical();
    this.#turnTo(at.theta, Math.PI / 2 - at.phi, this.#distance(), this.#centre.clone(), true);
  }

  turn(azimuth: number, height: number): void {
    this.#stand?.leave();
    const at = this.#spherical();
    const up = THREE.MathUtils.clamp(Math.PI / 2 - at.phi + height * TURN, -1.4, 1.4);
    this.#place(at.theta + azimuth * TURN, up, at.radius, this.controls.target);
  }

  zoom(by: number): void {
    const at = this.#spherical();
    const radius = THREE.MathUtils.clamp(at.radius * by, 0.12, 3);
    this.#place(at.theta, Math.PI / 2 - at.phi, radius, this.controls.target);
  }

  get orthographic(): boolean {
    return this.camera === this.#orthographic;
  }

  set orthographic(wanted: boolean) {
    this.#stand?.leave();
    const next = wanted ? this.#orthographic : this.#perspective;
    next.position.copy(this.camera.position);
    this.camera = next;
    this.controls.object = next;
    this.#resize();
    this.controls.update();
    this.draw();
  }

  // The picture as a PNG, without the page's background.
  still(width: number, height: number): Promise<Blob> {
    return this.posing(width, height, (snap) => snap("image/png"));
  }

  // Pictures of this size, taken one after the other: `snap` draws and keeps what is seen.
  async posing<T>(
    width: number, height: number, work: (snap: (type: string) => Promise<Blob>) => Promise<T>,
  ): Promise<T> {
    const ratio = this.renderer.getPixelRatio();
    this.renderer.setPixelRatio(1);
    this.#setSize(width, height);
    const snap = (type: string) => new Promise<Blob>((resolve, reject) => {
      this.drawNow();
      this.canvas.toBlob((blob) => {
        if (blob) resolve(blob);
        else reject(new Error("the browser could not make a picture; choose a smaller size"));
      }, type, 0.95);
    });
    try {
      return await work(snap);
    } finally {
      this.renderer.setPixelRatio(ratio);
      this.#resize();
    }
  }

  get azimuth(): number {
    return this.#spherical().theta;
  }

  set azimuth(azimuth: number) {
    const at = this.#spherical();
    this.#place(azimuth, Math.PI / 2 - at.phi, at.radius, this.controls.target);
  }

  #measure(): void {
    const box = new THREE.Box3().setFromObject(this.head!.root);
    box.getCenter(this.#centre);
    this.#radius = 0.5 * box.getSize(new THREE.Vector3()).y;
  }

  #distance(): number {
    const half = THREE.MathUtils.degToRad(FIELD / 2);
    const aspect = this.stage.clientWidth / Math.max(1, this.stage.clientHeight);
    return (1.28 * this.#radius) / Math.tan(half) / Math.min(1, aspect * 1.1) + 0.05;
  }

  #spherical(): THREE.Spherical {
    const away = this.camera.position.clone().sub(this.controls.target);
    return new THREE.Spherical().setFromVector3(away);
  }

  #place(azimuth: number, height: number, distance: number, target: THREE.Vector3): void {
    const away = new THREE.Vector3().setFromSphericalCoords(distance, Math.PI / 2 - height, azimuth);
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(away);
    this.#frame();
    this.controls.update();
    this.draw();
  }

  #turnTo(azimuth: number, height: number, distance: number, target: THREE.Vector3, gently: boolean) {
    cancelAnimationFrame(this.#animation);
    this.moving = false;
    if (!gently || matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.#place(azimuth, height, distance, target);
      return;
    }
    const from = this.#spherical();
    const start = this.controls.target.clone();
    const began = performance.now();
    const step = (now: number) => {
      const t = Math.min(1, Math.max(0, (now - began) / 320));
      const s = t * t * (3 - 2 * t);
      const mix = (a: number, b: number) => a + (b - a) * s;
      this.#place(
        mix(from.theta, azimuth),
        mix(Math.PI / 2 - from.phi, height),
        mix(from.radius, distance),
        start.clone().lerp(target, s),
      );
      this.moving = t < 1;
      if (this.moving) this.#animation = requestAnimationFrame(step);
    };
    this.moving = true;
    this.#animation = requestAnimationFrame(step);
  }

  #resize(): void {
    this.#setSize(this.stage.clientWidth, this.stage.clientHeight);
    this.draw();
  }

  #setSize(width: number, height: number): void {
    this.renderer.setSize(Math.max(1, width), Math.max(1, height), false);
    this.display?.resize(width, height);
    this.#stand?.resize(width, height);
    this.#perspective.aspect = width / Math.max(1, height);
    this.#perspective.updateProjectionMatrix();
    this.#frame();
  }

  // The orthographic camera shows what the other would at the same place.
  #frame(): void {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const half = distance * Math.tan(THREE.MathUtils.degToRad(FIELD / 2));
    const wide = half * this.#perspective.aspect;
    Object.assign(this.#orthographic, { left: -wide, right: wide, top: half, bottom: -half });
    this.#orthographic.updateProjectionMatrix();
  }
}
