// A script to begin with.

export const beginning = `-- x is to the right, y up, and z away from you.
Settings {
    width -> 640
    height -> 480
    gamma -> 2.2
    ambientmodel -> "surface"
    supersampling -> 3
    camera -> Camera {
        position -> vec3(2, 2.5, -6)
        pointing -> vec3(0, 0.8, 0)
        fov -> 40
    }
    lights -> [
        PointLight { origin -> vec3(-4, 7, -5) color -> rgb(1, 1, 1) ambient -> 0.15 }
    ]
    background -> Background { horizon -> rgb(0.85, 0.9, 1) sky -> rgb(0.35, 0.5, 0.8) }
}

red = Material { color -> rgb(0.8, 0.15, 0.1) specular -> 0.4 shininess -> 60 }
tiles = Material {
    color -> Checker { colorA -> rgb(0.8, 0.8, 0.75) colorB -> rgb(0.4, 0.4, 0.45) }
}

Scene {
    Sphere { center -> vec3(0, 1, 0) radius -> 1 material -> red }
    Plane { position -> vec3(0, 0, 0) normal -> vec3(0, 1, 0) material -> tiles }
}
`;
