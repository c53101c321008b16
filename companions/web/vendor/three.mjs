// The loaders of meshes of three.js, with its classes of geometry and empty ones in place of those
// of a picture: `three` of the loaders is `classes.mjs`.
export { ColladaLoader } from "./node_modules/three/examples/jsm/loaders/ColladaLoader.js";
export { GLTFLoader } from "./node_modules/three/examples/jsm/loaders/GLTFLoader.js";
export { OBJLoader } from "./node_modules/three/examples/jsm/loaders/OBJLoader.js";
export { STLLoader } from "./node_modules/three/examples/jsm/loaders/STLLoader.js";
export { Mesh, Vector3 } from "three";
