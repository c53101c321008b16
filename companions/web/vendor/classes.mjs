import { BufferAttribute } from "./node_modules/three/src/core/BufferAttribute.js";
import { Object3D } from "./node_modules/three/src/core/Object3D.js";
import { Color } from "./node_modules/three/src/math/Color.js";
import { Vector2 } from "./node_modules/three/src/math/Vector2.js";
export * from "./node_modules/three/src/constants.js";
export * from "./node_modules/three/src/core/BufferAttribute.js";
export * from "./node_modules/three/src/core/BufferGeometry.js";
export * from "./node_modules/three/src/core/InterleavedBuffer.js";
export * from "./node_modules/three/src/core/InterleavedBufferAttribute.js";
export * from "./node_modules/three/src/core/Object3D.js";
export * from "./node_modules/three/src/loaders/Loader.js";
export * from "./node_modules/three/src/loaders/LoaderUtils.js";
export * from "./node_modules/three/src/math/Box3.js";
export * from "./node_modules/three/src/math/Color.js";
export * from "./node_modules/three/src/math/ColorManagement.js";
export * from "./node_modules/three/src/math/MathUtils.js";
export * from "./node_modules/three/src/math/Matrix4.js";
export * from "./node_modules/three/src/math/Quaternion.js";
export * from "./node_modules/three/src/math/Sphere.js";
export * from "./node_modules/three/src/math/Vector2.js";
export * from "./node_modules/three/src/math/Vector3.js";
export * from "./node_modules/three/src/objects/Bone.js";
export * from "./node_modules/three/src/objects/Group.js";

export class Mesh extends Object3D {
  isMesh = true;
  constructor(geometry, material) {
    super();
    Object.assign(this, { geometry, material });
  }
  // Of meshes with bones, and of many in one.
  bind() {}
  normalizeSkinWeights() {}
  setMatrixAt() {}
}
/// Lights, cameras, lines and points.
class Unseen extends Object3D {
  color = new Color();
  target = new Object3D();
}
/// Materials, textures and motions: nothing is asked for, and nothing is drawn of them.
class Look {
  static sanitizeNodeName = (name) => name;
  color = new Color();
  emissive = new Color();
  specular = new Color();
  offset = new Vector2();
  repeat = new Vector2();
  userData = {};
  clone() {
    return this;
  }
  load(address, done) {
    done?.(new Look());
    return new Look();
  }
  setValues() {}
  setCrossOrigin() {
    return this;
  }
  setPath() {
    return this;
  }
  setRequestHeader() {}
  setResponseType() {}
  setWithCredentials() {}
}
export {
  BufferAttribute as InstancedBufferAttribute, Mesh as InstancedMesh, Mesh as SkinnedMesh,
  Unseen as AmbientLight, Unseen as DirectionalLight, Unseen as Line, Unseen as LineLoop, Unseen as LineSegments, Unseen as OrthographicCamera,
  Unseen as PerspectiveCamera, Unseen as PointLight, Unseen as Points, Unseen as Scene, Unseen as SpotLight,
  Look as AnimationClip, Look as DataTextureLoader, Look as FileLoader, Look as ImageBitmapLoader, Look as Interpolant, Look as LineBasicMaterial,
  Look as Material, Look as MeshBasicMaterial, Look as MeshLambertMaterial, Look as MeshPhongMaterial, Look as MeshPhysicalMaterial,
  Look as MeshStandardMaterial, Look as NumberKeyframeTrack, Look as PointsMaterial, Look as PropertyBinding, Look as QuaternionKeyframeTrack,
  Look as Skeleton, Look as Texture, Look as TextureLoader, Look as VectorKeyframeTrack,
};
