// What draws: whether it is a processor rather than a graphics card, and when it is done.

/** Names that browsers give to drawing by software. */
const softwareNames = /swiftshader|llvmpipe|softpipe|software|basic render/i;
/** Between two looks whether a frame is done, milliseconds. */
const lookEveryMs = 4;
/** A frame that is not done by then is not waited for (a lost context never is). */
const longestMs = 5000;

/** Smoothing edges in the usual way doubles what a triangle costs there. */
export function drawsBySoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info") ?? null;
  if (gl === null || info === null) return false;
  const name = String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return softwareNames.test(name);
}

/** Calls back with how long everything drawn since `start` has taken, once it is done. */
export function whenDrawn(gl: WebGL2RenderingContext, start: number, then: (milliseconds: number) => void): void {
  const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  const look = (): void => {
    const elapsed = performance.now() - start;
    const isDone = sync === null || gl.isContextLost() || gl.getSyncParameter(sync, gl.SYNC_STATUS) === gl.SIGNALED;
    if (!isDone && elapsed < longestMs) return void window.setTimeout(look, lookEveryMs);
    gl.deleteSync(sync);
    then(elapsed);
  };
  window.setTimeout(look, 0);
}
