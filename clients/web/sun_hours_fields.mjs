// The controls of the view of sun hours, as fields.mjs has them.

import { dateOf, sunHoursInForce, withDate } from './sun_hours.mjs';

const hours = (store) => sunHoursInForce(store.state.spec);

// The first touch sets the whole of it.
const set = (key) => (value, store) => store.setSpec('sunHours', { ...hours(store), [key]: value });

const angle = (key, label, ends, says) => ({
  path: `sunHours.${key}`, label, unit: '°', says, slider: ends, keeps: true, choose: set(key), value: (store) => hours(store)[key] ?? 0,
});

export const kSunHours = {
  title: 'Hours of sun',
  needs: ({ state }) => state.view === 'sunHours',
  fields: [
    { path: 'sunHours.begin', label: 'Day', says: 'From midnight to midnight by the mean sun of the place', date: true, keeps: true, choose: (date, store) => store.setSpec('sunHours', withDate(hours(store), date)), value: (store) => dateOf(hours(store)) },
    angle('latitudeDegrees', 'Latitude', [-90, 90, 0.1], 'North of the equator positive'),
    angle('longitudeDegrees', 'Longitude', [-180, 180, 0.1], 'East of Greenwich positive'),
    angle('northDegrees', 'North', [0, 360, 1], 'Where north lies in the scene, clockwise from -Z as seen from above'),
  ],
};
