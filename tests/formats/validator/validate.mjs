// Prints the report of the Khronos glTF validator on one file, as JSON.
//   node validate.mjs FILE
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import validator from "gltf-validator";

const file = process.argv[2];
const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
  uri: basename(file),
  maxIssues: 100,
  writeTimestamp: false,
});
console.log(JSON.stringify(report));
