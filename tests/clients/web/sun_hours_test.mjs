// The view of sun hours: its place and day, and what it sends.

import assert from 'node:assert/strict';
import test from 'node:test';

import { kSections } from '../../../clients/web/fields.mjs';
import { draftSpec, fullSpec } from '../../../clients/web/spec.mjs';
import { createStore } from '../../../clients/web/store.mjs';
import { dateOf, sunHoursInForce, withDate } from '../../../clients/web/sun_hours.mjs';

const kSize = { width: 80, height: 40 };
const section = kSections.find(({ title }) => title === 'Hours of sun');
const fieldOf = (label) => section.fields.find((field) => field.label === label);

test('hours are of the chosen day, else of the day of a sun by place and time, else of a first one', () => {
  const first = { latitudeDegrees: 48, longitudeDegrees: 12, begin: '2026-03-20T00:00:00+00:48', end: '2026-03-21T00:00:00+00:48' };
  assert.deepEqual(sunHoursInForce({}), first);
  const sun = { latitudeDegrees: -33, longitudeDegrees: 151, northDegrees: 7, time: '2026-12-31T17:00+10:00' };
  const there = { latitudeDegrees: -33, longitudeDegrees: 151, northDegrees: 7, begin: '2026-12-31T00:00:00+10:00', end: '2027-01-01T00:00:00+10:00' };
  assert.deepEqual(sunHoursInForce({ lights: [{}, { sun }] }), there);
  assert.deepEqual(sunHoursInForce({ environment: { sky: { sun } } }), there);
  const chosen = { latitudeDegrees: 1 };
  assert.equal(sunHoursInForce({ lights: [{ sun }], sunHours: chosen }), chosen);
});

test('a day is from midnight to midnight by the mean sun, and what else was chosen stays', () => {
  const west = withDate({ latitudeDegrees: 1, longitudeDegrees: -70.65, stepMinutes: 5, begin: 'x', end: 'y' }, '2028-02-28');
  assert.deepEqual(west, { latitudeDegrees: 1, longitudeDegrees: -70.65, stepMinutes: 5, begin: '2028-02-28T00:00:00-04:43', end: '2028-02-29T00:00:00-04:43' });
  assert.equal(dateOf(west), '2028-02-28');
  assert.equal(dateOf({ begin: 5 }), '5'); // a link may say anything
});

test('the view sends its hours, in longer steps while the hand moves', () => {
  const state = { view: 'sunHours', spec: {} };
  assert.deepEqual(fullSpec(state, kSize).sunHours, sunHoursInForce({}));
  assert.equal(draftSpec(state, kSize, 0.5).sunHours.stepMinutes, 30);
  assert.equal(fullSpec({ view: 'color', spec: {} }, kSize).sunHours, undefined);
});

test('its controls are there with the view, and the first touch sets the whole', () => {
  const store = createStore({ view: 'color', spec: {} });
  assert.equal(section.needs(store), false);
  store.update({ view: 'sunHours' });
  assert.equal(section.needs(store), true);
  fieldOf('Latitude').choose(60, store);
  assert.deepEqual(store.state.spec.sunHours, { ...sunHoursInForce({}), latitudeDegrees: 60 });
  fieldOf('Day').choose('2026-12-21', store);
  assert.equal(store.state.spec.sunHours.latitudeDegrees, 60);
  assert.equal(fieldOf('Day').value(store), '2026-12-21');
  assert.equal(fieldOf('North').value(store), 0);
});
