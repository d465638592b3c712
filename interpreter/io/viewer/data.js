// SPDX-License-Identifier: MIT
// The data of a page: a head in JSON and a block of tables (README.md has the layout).

const POSITION_STEPS = 65534;
export const VALUE_STEPS = 254;

async function inflate(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

function meshTables(block, mesh) {
  let at = mesh.at;
  const table = (length) => {
    const numbers = new Uint32Array(block.slice(at, at + 4 * length));
    at += 4 * length;
    for (let i = 1; i < length; ++i) numbers[i] += numbers[i - 1];
    return numbers;
  };
  const { all_points: allPoints, all_cells: allCells, points, cells, outline } = mesh;
  return {
    allPoints, allCells, points, cells, outline, // counts; the others are tables
    pointNumbers: table(mesh.points),
    cellNumbers: table(mesh.cells),
    triangles: table(3 * mesh.triangles),
    triangleCells: table(mesh.triangles),
    edges: table(2 * mesh.edges),
    lines: table(2 * mesh.lines),
    lineCells: table(mesh.lines),
    dots: table(mesh.dots),
    dotCells: table(mesh.dots),
  };
}

/** `count` steps from byte `at` on, as differences: their low bytes, then their high bytes. */
function stepTable(block, at, count, before) {
  const bytes = new Uint8Array(block, at, 2 * count);
  const steps = new Uint16Array(count);
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    sum += bytes[i] + 256 * bytes[count + i];
    steps[i] = sum + (before ? before[i] : 0);
  }
  return steps;
}

/** One run: frames by their position in the page. */
export class Run {
  constructor(head, block) {
    this.head = head;
    this.block = block;
    this.meshes = head.meshes.map((mesh) => meshTables(block, mesh));
    this.frames = head.frames;
    this.steps = [];
    // Frames are stored as the difference to the one before where that has the same mesh.
    this.frames.forEach((frame, k) => {
      const before = k > 0 && this.mesh(k) === this.mesh(k - 1) ? this.steps[k - 1] : null;
      this.steps.push(stepTable(block, frame.positions, 3 * this.mesh(k).points, before));
    });
  }

  mesh(frame) {
    return this.meshes[this.frames[frame].mesh];
  }

  /** x, y, z of point after point; NaN where the file has no finite number. */
  positions(frame) {
    const { low, high } = this.head;
    const steps = this.steps[frame];
    const count = steps.length / 3;
    const positions = new Float32Array(3 * count);
    for (let axis = 0; axis < 3; ++axis) {
      const scale = (high[axis] - low[axis]) / POSITION_STEPS;
      for (let i = 0; i < count; ++i) {
        const step = steps[axis * count + i];
        positions[3 * i + axis] = step > POSITION_STEPS ? NaN : low[axis] + step * scale;
      }
    }
    return positions;
  }

  /** Steps from 0 to VALUE_STEPS, above where there is no finite value; by point or by cell. */
  values(frame, field) {
    const mesh = this.mesh(frame);
    const count = this.head.fields[field].on === 'point' ? mesh.points : mesh.cells;
    return new Uint8Array(this.block, this.frames[frame].fields[field], count);
  }

  /** The number that a step stands for. */
  value(field, step) {
    const { low, high } = this.head.fields[field];
    return step > VALUE_STEPS ? NaN : low + (high - low) * step / VALUE_STEPS;
  }

  fieldNamed(name) {
    return this.head.fields.findIndex((field) => field.name === name);
  }
}

export async function loadRun() {
  if (!globalThis.DecompressionStream)
    throw new Error('this browser cannot inflate data; one from 2023 or later can');
  const text = (id) => document.getElementById(id).textContent;
  return new Run(JSON.parse(text('head')), await inflate(text('block')));
}
