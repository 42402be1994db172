// SPDX-License-Identifier: Apache-2.0

/** Kinds that the legend can hide. */
export type Kind = 'real' | 'simulated' | 'virtual' | 'wall' | 'landmark';

/** What the World View shows. Saved with the layout. */
export interface Layers {
  hidden: Kind[];
  trails: boolean;
  scans: 'off' | 'selected' | 'real';
  sightings: boolean;
  hits: boolean;
  names: boolean;
  grid: boolean;
}

export const kLayers: Layers = {
  hidden: [],
  trails: true,
  scans: 'real',
  sightings: true,
  hits: true,
  names: true,
  grid: true,
};

/** What was kept, with defaults for what is missing or odd. */
export function readLayers(kept: unknown): Layers {
  const given = typeof kept === 'object' && kept !== null ? (kept as Partial<Layers>) : {};
  const flag = (name: 'trails' | 'sightings' | 'hits' | 'names' | 'grid') =>
    typeof given[name] === 'boolean' ? given[name] : kLayers[name];
  return {
    hidden: Array.isArray(given.hidden) ? given.hidden : [],
    trails: flag('trails'),
    scans: given.scans === 'off' || given.scans === 'selected' ? given.scans : 'real',
    sightings: flag('sightings'),
    hits: flag('hits'),
    names: flag('names'),
    grid: flag('grid'),
  };
}
