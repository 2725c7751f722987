// Decodes LAZ files with a decoder that others wrote, compiled to WebAssembly: laz-perf or laz-rs.
//
// Usage: node independent_decoders.mjs DECODER PACKAGE RUNS IN.laz OUT [IN.laz OUT]...
// DECODER is laz-perf or laz-rs, PACKAGE the folder of the npm package that has it (laz-perf or @loaders.gl/las).
// Decodes each file RUNS times. Writes the records of a file without header to OUT, and a line of JSON to standard
// output: {"points": N, "seconds": [S...]}, or {"error": TEXT}. The seconds are processor time of decoding alone.
import fs from 'node:fs';
import path from 'node:path';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

const [decoder, folder, runs, ...files] = process.argv.slice(2);

// Processor seconds of this process.
function processorSeconds() {
  const {user, system} = process.cpuUsage();
  return (user + system) / 1e6;
}

async function lazPerf() {
  const {create} = createRequire(import.meta.url)(path.resolve(folder, 'lib', 'node', 'index.js'));
  const module = await create();
  return (bytes) => {
    const file = module._malloc(bytes.length);
    module.HEAPU8.set(bytes, file);
    const reader = new module.LASZip();
    let points = 0;
    try {
      reader.open(file, bytes.length);
      const length = reader.getPointLength();
      const count = reader.getCount();
      points = module._malloc(count * length);
      const start = processorSeconds();
      for (let i = 0; i < count; ++i) reader.getPoint(points + i * length);
      const seconds = processorSeconds() - start;
      return {records: module.HEAPU8.slice(points, points + count * length), count, seconds};
    } finally {
      reader.delete();
      module._free(points);
      module._free(file);
    }
  };
}

async function lazRs() {
  const libraries = path.resolve(folder, 'dist', 'libs', 'laz-rs-wasm');
  const {initSync, WasmLasZipDecompressor} = await import(pathToFileURL(path.join(libraries, 'laz_rs_wasm.js')));
  initSync({module: fs.readFileSync(path.join(libraries, 'laz_rs_wasm_bg.wasm'))});
  return (bytes) => {
    const reader = new WasmLasZipDecompressor(bytes);
    const length = bytes[105] | (bytes[106] << 8);
    const count = Number(reader.header.num_points);
    const records = new Uint8Array(count * length);
    const step = 10000 * length;  // decompress_many copies its argument there and back.
    const start = processorSeconds();
    for (let at = 0; at < records.length; at += step) reader.decompress_many(records.subarray(at, at + step));
    const seconds = processorSeconds() - start;
    reader.free();
    return {records, count, seconds};
  };
}

const decode = await {'laz-perf': lazPerf, 'laz-rs': lazRs}[decoder]();
for (let i = 0; i + 1 < files.length; i += 2) {
  try {
    const bytes = new Uint8Array(fs.readFileSync(files[i]));
    const results = Array.from({length: Number(runs)}, () => decode(bytes));
    fs.writeFileSync(files[i + 1], results[0].records);
    console.log(JSON.stringify({points: results[0].count, seconds: results.map((result) => result.seconds)}));
  } catch (error) {
    console.log(JSON.stringify({error: String(error)}));
  }
}
