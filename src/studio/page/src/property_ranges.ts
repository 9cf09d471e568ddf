// Within which numbers sliders go. A slider goes through what is usual: the field beside it takes
// more.

export interface Range {
  low: number;
  high: number;
  step: number;
}

const shares: Range = {low: 0, high: 1, step: 0.01};
const turn: Range = {low: 1, high: 360, step: 1};

export const ranges: Readonly<Record<string, Range>> = {
  'Material.reflectivity': shares,
  'Material.transparency': shares,
  'Material.refractiveindex': {low: 1, high: 3, step: 0.01},
  'Material.diffuse': shares,
  'Material.specular': {low: 0, high: 2, step: 0.01},
  'Material.shininess': {low: 0, high: 200, step: 1},
  'PrincipledMaterial.metallic': shares,
  'PrincipledMaterial.roughness': shares,
  'PrincipledMaterial.refractiveindex': {low: 1, high: 3, step: 0.01},
  'PrincipledMaterial.transmission': shares,
  'PrincipledMaterial.coat': shares,
  'PrincipledMaterial.coatroughness': shares,
  'PrincipledMaterial.sheen': shares,
  'Camera.fov': {low: 1, high: 179, step: 1},
  'Camera.roll': {low: -180, high: 180, step: 1},
  'Camera.aperture': {low: 0, high: 500, step: 1},
  'Camera.lensradius': {low: 0, high: 0.5, step: 0.001},
  'PointLight.ambient': shares,
  'PointLight.radius': {low: 0, high: 2, step: 0.01},
  'ParallelLight.ambient': shares,
  'ParallelLight.angle': {low: 0, high: 30, step: 0.1},
  'SpotLight.angle': turn,
  'SpotLight.penumbra': {low: 0, high: 45, step: 0.5},
  'SpotLight.ambient': shares,
  'CylinderLight.ambient': shares,
  'SphereLight.radius': {low: 0.01, high: 5, step: 0.01},
  'DiscLight.radius': {low: 0.01, high: 5, step: 0.01},
  'EnvironmentLight.scale': {low: 0, high: 4, step: 0.05},
  'Revolution.angle': turn,
  'Noise.octaves': {low: 1, high: 16, step: 1},
  'Marble.octaves': {low: 1, high: 16, step: 1},
  'Wood.octaves': {low: 1, high: 16, step: 1},
  'Settings.gamma': {low: 0.5, high: 3, step: 0.05},
  'Settings.exposure': {low: -6, high: 6, step: 0.1},
  'Settings.lightsamples': {low: 1, high: 16, step: 1},
  'Settings.indirect': {low: 0, high: 16, step: 1},
  'Settings.supersampling': {low: 1, high: 8, step: 1},
  'Settings.dofsamples': {low: 1, high: 64, step: 1},
  'Settings.recursiondepth': {low: 0, high: 16, step: 1},
  'Settings.filterwidth': {low: 1, high: 16, step: 0.5},
};
