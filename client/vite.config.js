// The page is built into the Python package, from where the server serves it.
export default {
  base: "./",
  build: {
    outDir: "../src/pdeface/studio/static",
    emptyOutDir: true,
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1200,
  },
};
