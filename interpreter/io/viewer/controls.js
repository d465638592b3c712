// SPDX-License-Identifier: MIT
// What the user reads and turns: label, slider, colours, keys, and the part of the address behind #.
import { cssGradient } from './colours.js';

const SHORTEST = 3, LONGEST = 20; // s, that playing all frames takes

const element = (id) => document.getElementById(id);
const counted = (count, one, many) => `${count} ${count === 1 ? one : many}`;
const digits = (value, count) => String(Number(value.toPrecision(count)));

function withUnit(value, field) {
  return digits(value, 4) + (field.unit ? ` ${field.unit}` : '');
}

export class Controls {
  constructor(run, drawing) {
    this.run = run;
    this.drawing = drawing;
    this.last = run.frames.length - 1;
    this.playing = false;
    element('title').textContent = run.head.title;
    element('slider').max = this.last;
    element('scale').style.background = cssGradient;
    this.listFields();
    this.listen();
    this.readHash(run.head.field);
    if (!this.hashNamesFrame && this.last > 0) this.play();
  }

  listFields() {
    element('field').append(new Option('nothing', -1));
    const { fields } = this.run.head;
    fields.forEach((field, i) => { // a name may stand for a field on points and one on cells
      const alone = fields.filter((other) => other.name === field.name).length === 1;
      element('field').append(new Option(alone ? field.name : `${field.name} (${field.on})`, i));
    });
  }

  listen() {
    element('slider').addEventListener('input', () => {
      this.pause();
      this.show(Number(element('slider').value));
    });
    element('play').addEventListener('click', () => (this.playing ? this.pause() : this.play()));
    element('field').addEventListener('change', () => this.setField(Number(element('field').value)));
    element('edges').addEventListener('change', () => this.drawing.setEdges(element('edges').checked));
    element('of_frame').addEventListener('change', () => {
      this.drawing.setOfFrame(element('of_frame').checked);
      this.showLegend();
    });
    addEventListener('hashchange', () => this.readHash(null));
    addEventListener('keydown', (event) => this.key(event));
    const canvas = this.drawing.renderer.domElement;
    let down = null; // a click turns nothing, a drag does
    canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener('pointerup', (event) => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4)
        this.pick(event.offsetX, event.offsetY);
    });
    canvas.addEventListener('dblclick', () => this.drawing.lookHome());
  }

  key(event) {
    if (event.target.tagName === 'SELECT' || event.ctrlKey || event.metaKey) return;
    const jump = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.key === ' ') this.playing ? this.pause() : this.play();
    else if (event.key === 'e') element('edges').click();
    else if (event.key === 'h') this.drawing.lookHome();
    else if (event.key === 'f') this.drawing.lookAtFrame();
    else if (jump) {
      this.pause();
      this.show(Math.min(Math.max(this.frame + jump, 0), this.last));
    } else return;
    event.preventDefault();
  }

  /** #frame=60&field=velocity&edges=off&range=frame&fit=frame; the frame by its number in the file. */
  readHash(firstField) {
    const hash = new URLSearchParams(location.hash.slice(1));
    element('notice').textContent = '';
    const field = hash.get('field') ?? firstField;
    if (field !== null) this.setFieldNamed(field);
    const frame = Number.parseInt(hash.get('frame'), 10);
    this.hashNamesFrame = Number.isFinite(frame);
    if (this.hashNamesFrame) this.pause();
    this.show(this.hashNamesFrame ? this.nearest(frame) : this.frame ?? 0);
    if (hash.has('edges')) {
      element('edges').checked = hash.get('edges') !== 'off';
      this.drawing.setEdges(element('edges').checked);
    }
    if (hash.get('fit') === 'frame') this.drawing.lookAtFrame();
    if (hash.has('range')) {
      element('of_frame').checked = hash.get('range') === 'frame';
      this.drawing.setOfFrame(element('of_frame').checked);
      this.showLegend();
    }
  }

  /** Not every frame of the file need be in the page. */
  nearest(number) {
    const wanted = number < 0 ? this.run.head.frames_in_file + number : number;
    const distance = (k) => Math.abs(this.run.frames[k].number - wanted);
    return this.run.frames.reduce((best, _, k) => (distance(k) < distance(best) ? k : best), 0);
  }

  setFieldNamed(name) {
    const field = name === '' ? -1 : this.run.fieldNamed(name);
    if (name !== '' && field < 0) element('notice').textContent = `there is no field ${name}`;
    this.setField(field, false);
  }

  setField(number, draw = true) {
    element('field').value = number;
    element('legend').hidden = number < 0;
    if (draw) this.drawing.setField(number);
    else this.drawing.field = number; // show() will draw it
    if (draw) this.showLegend();
    this.describePick();
  }

  showLegend() {
    const number = this.drawing.field;
    if (number < 0) return;
    const field = this.run.head.fields[number];
    const [low, high] = this.drawing.stepRange().map((step) => this.run.value(number, step));
    element('high').textContent = withUnit(high, field);
    element('middle').textContent = withUnit((low + high) / 2, field);
    element('low').textContent = withUnit(low, field);
    const length = field.components > 1 ? 'length, ' : '';
    const origin = field.expression && field.expression !== field.name ? ` = ${field.expression}` : '';
    const gaps = field.not_finite > 0 ? `; grey: not finite` : '';
    element('meaning').textContent = `${length}by ${field.on}${origin}${gaps}`;
  }

  show(k) {
    this.frame = k;
    this.drawing.show(k);
    const frame = this.run.frames[k];
    const mesh = this.run.mesh(k);
    element('slider').value = k;
    element('label').textContent =
      `t = ${digits(frame.time, 6)} s, frame ${frame.number} of ${this.run.head.frames_in_file}` +
      ` (step ${frame.step})\n${counted(mesh.allPoints, 'point', 'points')}, ` +
      `${counted(mesh.allCells, 'cell', 'cells')}` +
      (frame.tears > 0 ? `, ${counted(frame.tears, 'tear', 'tears')}` : '');
    document.body.dataset.frame = frame.number;
    this.showLegend();
    this.describePick();
  }

  pick(x, y) {
    const picked = this.drawing.pick(x, y);
    this.picked = picked && { ...picked, mesh: this.run.mesh(this.frame) };
    this.describePick();
  }

  /** What was clicked at, as long as its mesh is shown: numbers change with the mesh. */
  describePick() {
    const shown = this.picked && this.picked.mesh === this.run.mesh(this.frame);
    element('picked').textContent = shown ? this.pickText() : '';
  }

  pickText() {
    const { point, cell, mesh } = this.picked;
    const numbers = `point ${mesh.pointNumbers[point]}, cell ${mesh.cellNumbers[cell]}`;
    const number = this.drawing.field;
    if (number < 0) return numbers;
    const field = this.run.head.fields[number];
    const steps = this.run.values(this.frame, number);
    const value = this.run.value(number, steps[field.on === 'point' ? point : cell]);
    return `${numbers}: ${field.name} ≈ ${withUnit(value, field)}`;
  }

  /** As fast as the run went, unless that is over in a blink or takes too long. */
  play() {
    const times = this.run.frames.map((frame) => frame.time);
    const span = times[this.last] - times[0];
    if (!(span > 0)) return;
    const rate = span / Math.min(Math.max(span, SHORTEST), LONGEST);
    element('speed').textContent = rate === 1 ? 'real time' : `${digits(rate, 2)} × real time`;
    element('play').textContent = 'pause';
    const begin = this.frame === this.last ? 0 : times[this.frame] - times[0];
    const started = performance.now();
    this.playing = true;
    const advance = () => {
      if (!this.playing) return;
      const elapsed = begin + rate * (performance.now() - started) / 1000;
      const time = times[0] + elapsed % (span * (1 + 1 / Math.max(this.last, 1)));
      let k = this.last;
      while (k > 0 && times[k] > time) --k;
      if (k !== this.frame) this.show(k);
      requestAnimationFrame(advance);
    };
    requestAnimationFrame(advance);
  }

  pause() {
    this.playing = false;
    element('play').textContent = 'play';
  }
}
