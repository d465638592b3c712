// SPDX-License-Identifier: MIT
import { Color, SRGBColorSpace } from 'three';
import { VALUE_STEPS } from './data.js';

// Viridis at equal distances: even steps of lightness, also for the colour-blind and in grey.
const STOPS = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779',
  '#6ece58', '#b5de2b', '#fde725'];
export const PLAIN = new Color('#7fa8c9');
export const NO_VALUE = new Color('#b8b8b8');

export const cssGradient = `linear-gradient(to top, ${STOPS.join(', ')})`;

function colourAt(position) {
  const at = Math.min(position * (STOPS.length - 1), STOPS.length - 1.000001);
  const [low, high] = [STOPS[Math.floor(at)], STOPS[Math.floor(at) + 1]].map((stop) =>
    new Color(stop).getRGB({}, SRGBColorSpace));
  const mix = (channel) => low[channel] + (high[channel] - low[channel]) * (at % 1);
  return new Color().setRGB(mix('r'), mix('g'), mix('b'), SRGBColorSpace);
}

/** The colour of each step of a value, and last that of no value. */
export const COLOURS = [
  ...Array.from({ length: VALUE_STEPS + 1 }, (_, step) => colourAt(step / VALUE_STEPS)), NO_VALUE];
