// Shows a GLB in three.js and counts the pixels that its morph targets and its animation change.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

// Of 256 levels of a colour: what a change must reach to be seen rather than computed.
const VISIBLE = 8;

const canvas = document.querySelector("canvas");
const renderer = new THREE.WebGLRenderer({ canvas, antialias: false });
renderer.setSize(canvas.width, canvas.height, false);

// The file's metres: the camera stands in front of the face, which fills the picture.
const camera = new THREE.PerspectiveCamera(20, canvas.width / canvas.height, 0.05, 5);
camera.position.set(0, 0.01, 0.75);
camera.lookAt(0, 0.01, 0.1);

async function open(url) {
  const { scene: file, animations } = await new GLTFLoader().loadAsync(url);
  const scene = new THREE.Scene();
  const sun = new THREE.DirectionalLight(0xffffff, 2.5);
  sun.position.set(0.6, 0.9, 0.8);
  scene.add(file, sun, new THREE.AmbientLight(0xffffff, 0.6));
  const meshes = [];
  file.traverse((node) => node.isMesh && meshes.push(node));
  return { file, animations, meshes, scene };
}

// The colours on the canvas: (height x width x 4) bytes, the bottom row first.
function picture({ scene }) {
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * canvas.width * canvas.height);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels;
}

function set(meshes, weights) {
  for (const mesh of meshes) {
    mesh.morphTargetInfluences.fill(0);
    for (const [name, weight] of Object.entries(weights)) {
      mesh.morphTargetInfluences[mesh.morphTargetDictionary[name]] = weight;
    }
  }
}

const EVERYWHERE = { left: 0, right: canvas.width, bottom: 0, top: canvas.height };

function changed(one, other, { left, right, bottom, top } = EVERYWHERE) {
  let count = 0;
  for (let y = bottom; y < top; y++) {
    for (let x = left; x < right; x++) {
      const at = 4 * (y * canvas.width + x);
      const by = [0, 1, 2].map((k) => Math.abs(one[at + k] - other[at + k]));
      count += Math.max(...by) >= VISIBLE;
    }
  }
  return count;
}

// The pixels that lie over what is called so and on one side: +1 the subject's left, -1 the right.
function over(meshes, material, side) {
  const within = new THREE.Box2();
  for (const mesh of meshes.filter((each) => each.material.name === material)) {
    const points = mesh.geometry.attributes.position;
    for (let n = 0; n < points.count; n++) {
      const point = new THREE.Vector3().fromBufferAttribute(points, n).applyMatrix4(mesh.matrixWorld);
      if (point.x * side > 0) within.expandByPoint(point.project(camera));
    }
  }
  const column = (x) => Math.round(((x + 1) / 2) * canvas.width);
  const row = (y) => Math.round(((y + 1) / 2) * canvas.height);
  const { min, max } = within;
  return { left: column(min.x), right: column(max.x), bottom: row(min.y), top: row(max.y) };
}

// For each target at weight 1, the pixels that it changes; `open` is what must be so to see it.
window.targets = async (url, before) => {
  const shown = await open(url);
  const { meshes } = shown;
  const names = Object.keys(meshes[0].morphTargetDictionary);
  const pictureOf = (weights) => (set(meshes, weights), picture(shown));
  const rest = pictureOf({});
  const changes = names.map((name) => {
    const without = before[name] ? pictureOf(before[name]) : rest;
    return [name, changed(without, pictureOf({ ...before[name], [name]: 1 }))];
  });
  return {
    influences: meshes.map((mesh) => mesh.morphTargetInfluences.length),
    names: meshes.map((mesh) => Object.keys(mesh.morphTargetDictionary)),
    changes: Object.fromEntries(changes),
    back: changed(rest, pictureOf({})),
    size: changed(rest, new Uint8Array(rest.length)),
  };
};

// For each recorded time, the pixels that differ from the first, over either eye and elsewhere.
window.take = async (url) => {
  const shown = await open(url);
  const [clip] = shown.animations;
  const mixer = new THREE.AnimationMixer(shown.file);
  mixer.clipAction(clip).play();
  const times = [...clip.tracks[0].times];
  const pictures = times.map((time) => (mixer.setTime(time), picture(shown)));
  const [left, right] = [1, -1].map((side) => over(shown.meshes, "eye", side));
  const counts = (area) => pictures.map((each) => changed(pictures[0], each, area));
  return { times, left: counts(left), right: counts(right), all: counts() };
};
