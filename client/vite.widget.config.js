import { copyFile } from "node:fs/promises";
import { join } from "node:path";

const OUT = "../src/pdeface/studio/static";

const style = {
  name: "style",
  closeBundle: () => copyFile(join(import.meta.dirname, "src/style/widget.css"), join(import.meta.dirname, OUT, "widget.css")),
};

// The face in notebooks: one file, which the notebook's kernel hands to the page.
export default {
  plugins: [style],
  build: {
    outDir: OUT,
    emptyOutDir: false,
    lib: { entry: "src/widget.ts", formats: ["es"], fileName: () => "widget.js" },
    chunkSizeWarningLimit: 1200,
  },
};
