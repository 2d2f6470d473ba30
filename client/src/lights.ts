// A portrait studio that stands around the camera: a large soft light from the upper left, a fill,
// and two rims from behind. It turns with the camera, so that no side of a face is in the dark.

import * as THREE from "three";

// Intensities of key, fill, the two rims, what comes from everywhere, and what surrounds the face.
interface Mood {
  readonly lamps: readonly [number, number, number, number];
  readonly all: number;
  readonly around: number;
}

// A photo brings its own light: what is added to it is nearly even. Form alone is modelled by light.
const EVEN: Mood = { lamps: [0.75, 0.45, 0.35, 0.3], all: 1.15, around: 0.5 };
const FORM: Mood = { lamps: [1.7, 0.5, 0.9, 0.6], all: 0.5, around: 0.5 };
// Where nothing surrounds the face, which takes a processor seconds to draw.
const INSTEAD = 0.8;

const LAMPS = [
  { colour: 0xfff4e6, at: [-0.75, 0.9, 1.1] },
  { colour: 0xe6edff, at: [1.2, 0.15, 0.8] },
  { colour: 0xcfe0ff, at: [1.1, 0.7, -0.9] },
  { colour: 0xffe2c8, at: [-1.2, 0.3, -0.8] },
] as const;

export class Lights {
  #rig = new THREE.Group();
  #lamps: THREE.DirectionalLight[];
  #all = new THREE.HemisphereLight(0xf6f7ff, 0x9b8b7e);

  constructor(
    private scene: THREE.Scene,
    private renderer: THREE.WebGLRenderer,
    private surrounded: boolean,
  ) {
    this.#lamps = LAMPS.map(({ colour, at }) => {
      const lamp = new THREE.DirectionalLight(colour);
      lamp.position.fromArray([...at]);
      this.#rig.add(lamp, lamp.target);
      return lamp;
    });
    this.#all.position.set(0, 1, 0.35);
    this.#rig.add(this.#all);
    scene.add(this.#rig);
    this.surround();
    this.even = true;
  }

  // Nearly the same from everywhere, or such that form is seen.
  set even(even: boolean) {
    const { lamps, all, around } = even ? EVEN : FORM;
    this.#lamps.forEach((lamp, n) => (lamp.intensity = lamps[n]!));
    this.#all.intensity = all + (this.surrounded ? 0 : INSTEAD);
    this.scene.environmentIntensity = around;
  }

  follow(eye: THREE.Camera): void {
    this.#rig.quaternion.copy(eye.quaternion);
    this.scene.environmentRotation.setFromQuaternion(eye.quaternion);
  }

  // What surrounds the face; drawn by the graphics card, and lost with its memory.
  surround(): void {
    if (this.surrounded) this.scene.environment = softboxes(this.renderer);
  }
}

// What shines in the eyes: white panels in a dim room.
function softboxes(renderer: THREE.WebGLRenderer): THREE.Texture {
  const room = new THREE.Scene();
  room.background = new THREE.Color(0x4a4a50);
  const panel = (x: number, y: number, z: number, width: number, height: number, glow: number) => {
    const material = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
    material.color.setScalar(glow);
    const box = new THREE.Mesh(new THREE.PlaneGeometry(width, height), material);
    box.position.set(x, y, z);
    box.lookAt(0, 0, 0);
    room.add(box);
  };
  panel(-4, 4, 5, 4, 4, 9);
  panel(5, 1, 4, 1.6, 5, 3);
  panel(0, 7, 0, 8, 8, 1.6);
  const generator = new THREE.PMREMGenerator(renderer);
  const texture = generator.fromScene(room, 0.02).texture;
  generator.dispose();
  return texture;
}
