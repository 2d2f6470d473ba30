import { copyFile, mkdir } from "node:fs/promises";
import { join } from "node:path";

const OUT = "../src/pdeface/studio/static";

// The tracker's program, which it asks for by its address: from here, and from nowhere else.
const TRACKER = ["vision_wasm_module_internal.js", "vision_wasm_module_internal.wasm"];

const tracker = {
  name: "tracker",
  async closeBundle() {
    const from = join(import.meta.dirname, "node_modules/@mediapipe/tasks-vision/wasm");
    const to = join(import.meta.dirname, OUT, "tracker");
    await mkdir(to, { recursive: true });
    for (const file of TRACKER) await copyFile(join(from, file), join(to, file));
  },
};

// The page is built into the Python package, from where the server serves it.
export default {
  base: "./",
  plugins: [tracker],
  worker: { format: "es" },
  build: {
    outDir: OUT,
    emptyOutDir: true,
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1200,
  },
};
