// The numbers of a report's errors, named for people: [[name, value, what it says]]. Pure.

import { short } from './dom.mjs';

export const percent = (share) => (share === 0 ? '0 %' : share < 0.0001 ? '< 0.01 %' : `${short(100 * share)} %`);
const pixels = (number) => `${short(Number(number.toFixed(2)))} px`;

export function predictedNumbers(predicted) {
  if (!predicted) return [];
  return [['Texel', `${pixels(predicted.median)}, at most ${pixels(predicted.max)}`, 'How large a texel of the shadow map looks: median and worst; estimated from the plan']];
}

export function measuredNumbers(error) {
  if (!error) return [];
  const rows = [['Wrong', percent(error.misclassified), 'Share of the receivers that the frame and ray tracing classify differently']];
  if (error.misclassified > 0) {
    rows.push(
      ['Acne', percent(error.acne), 'A surface that shadows itself'],
      ['Leaks', percent(error.leak), 'Light where none can come, or a shadow detached from its caster'],
    );
  }
  if (error.edgeDisplacement) rows.push(['Edges off by', `${pixels(error.edgeDisplacement.mean)}, at most ${pixels(error.edgeDisplacement.max)}`, 'Distance from the true edge: mean and worst']);
  return rows;
}
