// In the browser: PlayCanvas with a directional light of four cascades.
import * as pc from 'playcanvas';
import { offer } from './frames.mjs';

async function startApp(canvas, setup) {
  const options = new pc.AppOptions();
  options.graphicsDevice = new pc.WebglGraphicsDevice(canvas, { antialias: setup.antialias });
  options.componentSystems = [pc.RenderComponentSystem, pc.CameraComponentSystem, pc.LightComponentSystem];
  options.resourceHandlers = [pc.TextureHandler, pc.ContainerHandler];
  const app = new pc.AppBase(canvas);
  app.init(options);
  app.setCanvasFillMode(pc.FILLMODE_NONE, setup.width, setup.height);
  app.setCanvasResolution(pc.RESOLUTION_FIXED, setup.width, setup.height);
  app.start();
  cancelAnimationFrame(app.frameRequestId); // frames are drawn when they are asked for
  return app;
}

async function addModel(app, setup) {
  const asset = new pc.Asset('scene', 'container', { url: setup.url });
  app.assets.add(asset);
  await new Promise((done, fail) => {
    asset.once('load', done);
    asset.once('error', (problem) => fail(new Error(problem)));
    app.assets.load(asset);
  });
  const model = asset.resource.instantiateRenderEntity({ castShadows: true, receiveShadows: true });
  for (const { entity } of [...model.findComponents('light'), ...model.findComponents('camera')]) entity.enabled = false;
  app.root.addChild(model);
}

// The four cascades share one square map, a quarter each.
function addSun(app, setup) {
  const sun = new pc.Entity('sun');
  sun.addComponent('light', {
    type: 'directional', intensity: setup.sunIntensity / Math.PI, castShadows: true, shadowType: pc.SHADOW_PCF5_32F,
    numCascades: setup.cascades, shadowResolution: 2 * setup.mapSize, shadowDistance: setup.shadowDistance,
    shadowBias: 0.2, normalOffsetBias: 0.05,
  });
  const direction = new pc.Vec3(...setup.towardsSun).normalize().mulScalar(-1);
  sun.setRotation(new pc.Quat().setFromDirections(pc.Vec3.DOWN, direction));
  app.root.addChild(sun);
}

async function open(canvas, setup) {
  const app = await startApp(canvas, setup);
  await addModel(app, setup);
  const ambient = setup.ambient ** (1 / 2.2); // read as sRGB
  app.scene.ambientLight = new pc.Color(ambient, ambient, ambient);
  addSun(app, setup);
  const { fovYDegrees, near, far, target, up } = setup.camera;
  const camera = new pc.Entity('camera');
  camera.addComponent('camera', {
    clearColor: new pc.Color(...setup.background), fov: fovYDegrees, nearClip: near, farClip: far,
  });
  app.root.addChild(camera);
  const [aim, above] = [new pc.Vec3(...target), new pc.Vec3(...up)];
  function draw(eye) {
    camera.setPosition(...eye);
    camera.lookAt(aim, above);
    app.update(0);
    app.render();
  }
  return { draw, version: pc.version };
}

offer(open);
