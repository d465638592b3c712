// SPDX-License-Identifier: MIT
// The picture: surface, edges, lines and dots of one frame after the other.
import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide,
  LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, PerspectiveCamera, Points,
  PointsMaterial, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { COLOURS, PLAIN } from './colours.js';
import { VALUE_STEPS } from './data.js';

const LINE_WIDTH = 3; // pixels
const OUTLINE_WIDTH = 2;
const DOT_SIZE = 6;
const MARGIN = 1.2; // 1: the box of the run touches the sides of the window

/** A table of points by number as one of their coordinates, corner after corner. */
function gather(positions, corners, into) {
  for (let i = 0; i < corners.length; ++i)
    for (let axis = 0; axis < 3; ++axis) into[3 * i + axis] = positions[3 * corners[i] + axis];
}

function fatLines(count, material) {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(new Float32Array(6 * count));
  if (material.vertexColors) geometry.setColors(new Float32Array(6 * count));
  const lines = new LineSegments2(geometry, material);
  lines.visible = count > 0;
  return lines;
}

export class Drawing {
  constructor(container, run) {
    this.run = run;
    this.field = -1;
    this.edges = true;
    this.ofFrame = false; // colours go over the range of the frame shown, not of the run
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    container.append(this.renderer.domElement);
    this.scene = new Scene();
    this.scene.background = new Color('#eef1f4');
    this.materials = {
      surface: new MeshLambertMaterial({
        vertexColors: true, side: DoubleSide, flatShading: true,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
      edges: new LineBasicMaterial({ color: '#16202b', transparent: true, opacity: 0.45 }),
      outline: new LineMaterial({ color: '#16202b', linewidth: OUTLINE_WIDTH }),
      lines: new LineMaterial({ vertexColors: true, linewidth: LINE_WIDTH }),
      dots: new PointsMaterial({ vertexColors: true, size: DOT_SIZE, sizeAttenuation: false }),
    };
    this.placeCamera();
    this.resize();
    addEventListener('resize', () => this.resize());
  }

  /** Looks at the box of the whole run: flat ones from the front, others from above with z up. */
  placeCamera() {
    const { low, high } = this.run.head;
    this.box = new Box3(new Vector3(...low), new Vector3(...high));
    this.radius = this.box.getSize(new Vector3()).length() / 2 || 1;
    const flat = high[2] - low[2] < 1e-6 * this.radius;
    this.direction = flat ? new Vector3(0, 0, 1) : new Vector3(0.5, -1, 0.45).normalize();
    this.camera = new PerspectiveCamera(30, 1, this.radius / 1000, this.radius * 100);
    this.camera.up.set(0, flat ? 1 : 0, flat ? 0 : 1);
    this.scene.add(this.camera, new AmbientLight('#ffffff', 1.7));
    const light = new DirectionalLight('#ffffff', 1.9);
    light.position.set(0.3, 0.5, 1); // beside the eye, so that facets differ
    this.camera.add(light);
    this.camera.add(light.target);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());
  }

  /** Back to where the page began. */
  lookHome() {
    this.lookAt(this.box);
  }

  /** At where the body is now: a piece that fell far makes the box of the run large. */
  lookAtFrame() {
    const box = new Box3();
    const positions = this.run.positions(this.frame);
    for (let i = 0; i < positions.length; i += 3) {
      const point = new Vector3().fromArray(positions, i);
      if (Number.isFinite(point.x + point.y + point.z)) box.expandByPoint(point);
    }
    if (!box.isEmpty()) this.lookAt(box);
  }

  lookAt(box) {
    const { camera } = this;
    const center = box.getCenter(new Vector3());
    camera.position.copy(center).add(this.direction);
    camera.lookAt(center);
    camera.updateMatrixWorld();
    const rise = Math.tan(camera.fov / 2 * Math.PI / 180) / MARGIN;
    let distance = this.radius / 100;
    for (let corner = 0; corner < 8; ++corner) {
      const [x, y, z] = [1, 2, 4].map((bit, axis) =>
        (corner & bit ? box.max : box.min).getComponent(axis));
      const seen = new Vector3(x, y, z).applyMatrix4(camera.matrixWorldInverse);
      // The camera is one unit from the center along its z axis.
      distance = Math.max(distance, seen.z + 1 +
        Math.max(Math.abs(seen.x) / (rise * camera.aspect), Math.abs(seen.y) / rise));
    }
    camera.position.copy(center).addScaledVector(this.direction, distance);
    this.controls.target.copy(center);
    this.controls.update();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.renderer.domElement.parentElement;
    const first = !this.width;
    this.width = width;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (first) this.lookHome();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }

  show(frame) {
    this.frame = frame;
    const mesh = this.run.mesh(frame);
    if (mesh !== this.mesh) this.buildMesh(mesh);
    const positions = this.run.positions(frame);
    gather(positions, mesh.triangles, this.surface.geometry.attributes.position.array);
    gather(positions, mesh.dots, this.dots.geometry.attributes.position.array);
    this.edgeLines.geometry.attributes.position.array.set(positions);
    gather(positions, mesh.lines, this.lines.geometry.attributes.instanceStart.data.array);
    gather(positions, mesh.edges.subarray(0, 2 * mesh.outline),
      this.outline.geometry.attributes.instanceStart.data.array);
    for (const part of [this.surface, this.dots, this.edgeLines])
      part.geometry.attributes.position.needsUpdate = true;
    for (const part of [this.lines, this.outline])
      part.geometry.attributes.instanceStart.data.needsUpdate = true;
    this.colour();
  }

  /** New buffers, for a mesh that another frame did not have. */
  buildMesh(mesh) {
    for (const part of this.parts ?? []) {
      this.scene.remove(part);
      part.geometry.dispose();
    }
    this.mesh = mesh;
    const coloured = (corners) => new BufferGeometry()
      .setAttribute('position', new BufferAttribute(new Float32Array(3 * corners), 3))
      .setAttribute('color', new BufferAttribute(new Float32Array(3 * corners), 3));
    this.surface = new Mesh(coloured(mesh.triangles.length), this.materials.surface);
    this.dots = new Points(coloured(mesh.dots.length), this.materials.dots);
    const geometry = new BufferGeometry()
      .setAttribute('position', new BufferAttribute(new Float32Array(3 * mesh.points), 3))
      .setIndex(new BufferAttribute(mesh.edges.slice(2 * mesh.outline), 1));
    this.edgeLines = new LineSegments(geometry, this.materials.edges);
    this.edgeLines.visible = this.edges;
    this.outline = fatLines(mesh.outline, this.materials.outline);
    this.lines = fatLines(mesh.lines.length / 2, this.materials.lines);
    this.parts = [this.surface, this.dots, this.edgeLines, this.outline, this.lines];
    for (const part of this.parts) {
      part.frustumCulled = false; // bounds would have to be computed in every frame
      this.scene.add(part);
    }
  }

  /** The least and the largest step that the colours stand for. */
  stepRange() {
    const whole = [0, VALUE_STEPS];
    if (!this.ofFrame) return whole;
    let [low, high] = [VALUE_STEPS, 0];
    for (const step of this.run.values(this.frame, this.field)) {
      if (step > VALUE_STEPS) continue;
      low = Math.min(low, step);
      high = Math.max(high, step);
    }
    return low <= high ? [low, high] : whole;
  }

  /** Colours what is drawn by the field, and draws it. */
  colour() {
    const { mesh } = this;
    const [low, high] = this.field < 0 ? [] : this.stepRange();
    const colourOf = (step) => COLOURS[step > VALUE_STEPS ? step
      : Math.round((step - low) / Math.max(high - low, 1) * VALUE_STEPS)];
    const paint = (corners, cells, perCell, into) => {
      const values = this.field < 0 ? null : this.run.values(this.frame, this.field);
      const byPoint = values && this.run.head.fields[this.field].on === 'point';
      for (let i = 0; i < corners.length; ++i) {
        const row = byPoint ? corners[i] : cells[Math.floor(i / perCell)];
        const colour = values ? colourOf(values[row]) : PLAIN;
        colour.toArray(into, 3 * i);
      }
    };
    paint(mesh.triangles, mesh.triangleCells, 3, this.surface.geometry.attributes.color.array);
    paint(mesh.dots, mesh.dotCells, 1, this.dots.geometry.attributes.color.array);
    const lineColours = this.lines.geometry.attributes.instanceColorStart.data;
    paint(mesh.lines, mesh.lineCells, 2, lineColours.array);
    lineColours.needsUpdate = true;
    for (const part of [this.surface, this.dots])
      part.geometry.attributes.color.needsUpdate = true;
    this.draw();
  }

  setField(field) {
    this.field = field;
    this.colour();
  }

  setOfFrame(ofFrame) {
    this.ofFrame = ofFrame;
    this.colour();
  }

  setEdges(edges) {
    this.edges = edges;
    this.edgeLines.visible = edges;
    this.draw();
  }

  /** The point and the cell of the surface under a place in the window; nothing beside it. */
  pick(x, y) {
    const { clientWidth: width, clientHeight: height } = this.renderer.domElement;
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(2 * x / width - 1, 1 - 2 * y / height), this.camera);
    this.surface.geometry.computeBoundingSphere();
    const [hit] = caster.intersectObject(this.surface);
    if (!hit) return null;
    const corners = [hit.face.a, hit.face.b, hit.face.c];
    const position = this.surface.geometry.attributes.position;
    const distance = (corner) =>
      new Vector3().fromBufferAttribute(position, corner).distanceTo(hit.point);
    corners.sort((a, b) => distance(a) - distance(b));
    return { point: this.mesh.triangles[corners[0]], cell: this.mesh.triangleCells[hit.faceIndex] };
  }
}
