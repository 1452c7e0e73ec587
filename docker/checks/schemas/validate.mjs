// Checks built manifests against published schemas: types, formats and what is required here, by ajv; and writes them as
// TypeScript, whose compiler then refuses fields that there are not.
//
// usage: node validate.mjs TYPESCRIPT FILE...
import fs from "node:fs";
import { createRequire } from "node:module";
import { loadAll } from "js-yaml";

const require = createRequire(import.meta.url);
const [typescript, ...files] = process.argv.slice(2);
const packageOf = (apiVersion) =>
  apiVersion.startsWith("monitoring.coreos.com/")
    ? `@kubernetes-models/prometheus-operator/${apiVersion}`
    : `kubernetes-models/${apiVersion}`;

let text = "";
let count = 0;
let faults = 0;
for (const file of files) {
  for (const object of loadAll(fs.readFileSync(file, "utf8"))) {
    const { apiVersion, kind } = object;
    const name = packageOf(apiVersion);
    if (kind === "Secret") {
      // Base64 in several lines, as kustomize writes it, is no fault.
      for (const key in object.data) object.data[key] = object.data[key].replace(/\s/g, "");
    }
    try {
      const types = name.startsWith("@") ? await import(name) : require(name);
      new types[kind](object).validate();
    } catch (error) {
      faults += 1;
      console.error(`${file}: ${kind} ${object.metadata?.name}: ${error.message}`);
    }
    count += 1;
    text += `import type { I${kind} as Kind${count} } from "${name}";\n`;
    text += `export const object${count}: Kind${count} = ${JSON.stringify(object, null, 1)};\n`;
  }
}
fs.writeFileSync(typescript, text);
console.log(`${count} objects, ${faults} that break their schema`);
process.exit(faults || !count ? 1 : 0);
