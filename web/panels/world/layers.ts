// SPDX-License-Identifier: Apache-2.0

/** Kinds that the legend can hide. */
export type Kind = 'real' | 'simulated' | 'virtual' | 'wall' | 'landmark';
/** Which poses robots are drawn at: `both` marks the true one beside the reported one. */
export type Poses = 'reported' | 'both' | 'true';
export type ColourBy = 'kind' | 'team' | 'speed' | 'age';

/** What the World View shows. Saved with the layout. */
export interface Layers {
  hidden: Kind[];
  poses: Poses;
  trails: boolean;
  scans: 'off' | 'selected' | 'real';
  sightings: boolean;
  hits: boolean;
  uncertainty: boolean;
  /** Of real robots: their simulated twins, with the gap. */
  shadows: boolean;
  names: boolean;
  grid: boolean;
  density: boolean;
  minimap: boolean;
  colourBy: ColourBy;
}

export type Flag = {[K in keyof Layers]: Layers[K] extends boolean ? K : never}[keyof Layers];

export const kColourBy: readonly ColourBy[] = ['kind', 'team', 'speed', 'age'];

export const kLayers: Layers = {
  hidden: [],
  poses: 'reported',
  trails: true,
  scans: 'real',
  sightings: true,
  hits: true,
  uncertainty: true,
  shadows: true,
  names: true,
  grid: true,
  density: true,
  minimap: true,
  colourBy: 'kind',
};

/** What was kept, with defaults for what is missing or odd. */
export function readLayers(kept: unknown): Layers {
  const given = typeof kept === 'object' && kept !== null ? (kept as Partial<Layers>) : {};
  const layers: Layers = {...kLayers, hidden: Array.isArray(given.hidden) ? given.hidden : []};
  for (const name of [
    'trails',
    'sightings',
    'hits',
    'uncertainty',
    'shadows',
    'names',
    'grid',
    'density',
    'minimap',
  ] satisfies Flag[]) {
    if (typeof given[name] === 'boolean') layers[name] = given[name];
  }
  if (given.poses === 'both' || given.poses === 'true') layers.poses = given.poses;
  if (given.scans === 'off' || given.scans === 'selected') layers.scans = given.scans;
  if (given.colourBy !== undefined && kColourBy.includes(given.colourBy))
    layers.colourBy = given.colourBy;
  return layers;
}
