// SPDX-License-Identifier: Apache-2.0
// What the World View shows, for tests: pictures, and what is written on canvases.

/** Notes what is written on canvases from now on; before the page is loaded. */
export async function noteTexts(page) {
  await page.addInitScript(() => {
    window.written = new Set();
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
      window.written.add(text);
      return write.call(this, text, ...place);
    };
  });
}

/** What the next picture of the World View has in words. */
export const texts = (page) =>
  page.evaluate(() => {
    window.written.clear();
    document.querySelector('rave-world').paint();
    return [...window.written];
  });

/** What a picture has in words, and how many pixels differ from the kept one, if robots had these
 * flags besides: pairs of slot and flag. */
export const withFlags = (page, more) =>
  page.evaluate((more) => {
    const world = document.querySelector('rave-world');
    const {flags} = world.placed;
    const before = [...flags];
    for (const [slot, flag] of more) flags[slot] |= flag;
    window.written.clear();
    const now = world.stage.snapshot();
    flags.set(before);
    const of = (canvas) => canvas.getContext('2d').getImageData(0, 0, now.width, now.height).data;
    const [a, b] = [of(window.kept), of(now)];
    return {
      texts: [...window.written],
      pixels: a.reduce((sum, value, i) => sum + (Math.abs(value - b[i]) > 24 ? 1 : 0), 0),
    };
  }, more);

/** Keeps the picture that is shown now, to compare others with. */
export const keep = (page) =>
  page.evaluate(() => {
    window.kept = document.querySelector('rave-world').stage.snapshot();
  });

/** How many pixels differ from the picture that was kept; `box`: left, top, right and bottom,
 * pixels of the page. */
export const differ = (page, box = null) =>
  page.evaluate((box) => {
    const now = document.querySelector('rave-world').stage.snapshot();
    const [x0, y0, x1, y1] = (box ?? [0, 0, now.width, now.height]).map(Math.round);
    const of = (canvas) =>
      canvas.getContext('2d', {willReadFrequently: true}).getImageData(x0, y0, x1 - x0, y1 - y0)
        .data;
    const [a, b] = [of(window.kept), of(now)];
    let count = 0;
    for (let i = 0; i < a.length; i += 4)
      if (
        Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) >
        24
      )
        ++count;
    return count;
  }, box);

/** The colour behind the middle of a robot, away from its heading, beside a colour of the page. */
export const inside = (page, slot, token) =>
  page.evaluate(
    ([slot, token]) => {
      const world = document.querySelector('rave-world');
      const {palette} = document.querySelector('rave-app');
      const picture = world.stage.snapshot();
      const yaw = world.placed.yaw[slot];
      const [x, y] = world.stage.screenAt(
        world.placed.x[slot] - 0.06 * Math.cos(yaw),
        world.placed.y[slot] - 0.06 * Math.sin(yaw),
      );
      const pen = document.createElement('canvas').getContext('2d');
      pen.fillStyle = token === 'fill' ? palette.hue(slot).fill : palette.token(token);
      pen.fillRect(0, 0, 1, 1);
      return {
        is: [...picture.getContext('2d').getImageData(x, y, 1, 1).data],
        wanted: [...pen.getImageData(0, 0, 1, 1).data],
      };
    },
    [slot, token],
  );

/** Where a robot is on the page. */
export const robotAt = (page, slot) =>
  page.evaluate((slot) => {
    const world = document.querySelector('rave-world');
    const box = world.renderRoot.querySelector('.canvas').getBoundingClientRect();
    const [x, y] = world.screenOf(slot);
    return [box.left + x, box.top + y];
  }, slot);

/** Where the World View is on the page. */
export const stageBox = (page) =>
  page.evaluate(() => {
    const {left, top, width, height} = document
      .querySelector('rave-world')
      .renderRoot.querySelector('.canvas')
      .getBoundingClientRect();
    return {left, top, width, height};
  });
