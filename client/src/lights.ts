// A portrait studio: a large soft light from the upper left, a fill, and two rims from behind.

import * as THREE from "three";

// Without what surrounds the face, which takes a processor seconds to draw, there is more light
// from everywhere.
export function light(scene: THREE.Scene, renderer: THREE.WebGLRenderer, surrounded: boolean): void {
  if (surrounded) surround(scene, renderer);
  const lamp = (colour: number, intensity: number, x: number, y: number, z: number) => {
    const sun = new THREE.DirectionalLight(colour, intensity);
    sun.position.set(x, y, z);
    return sun;
  };
  scene.add(
    lamp(0xfff1e0, 1.7, -0.75, 0.9, 1.1),
    lamp(0xdfe9ff, 0.55, 1.2, 0.15, 0.8),
    lamp(0xcfe0ff, 1.1, 1.1, 0.7, -0.9),
    lamp(0xffe2c8, 0.7, -1.2, 0.3, -0.8),
    new THREE.HemisphereLight(0xf2f4ff, 0x8d7a6c, surrounded ? 0.55 : 1.35),
  );
}

// What surrounds the face; drawn by the graphics card, and lost with its memory.
export function surround(scene: THREE.Scene, renderer: THREE.WebGLRenderer): void {
  scene.environment = softboxes(renderer);
  scene.environmentIntensity = 0.55;
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
