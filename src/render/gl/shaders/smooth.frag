#version 330 core
// Smooths the surface of water along one axis of the picture: a bell-weighted mean of the depths on both sides of a
// pixel, in a narrow range of depth (N. Truong and C. Yuksel, "A narrow-range filter for screen-space fluid rendering",
// 2018). What lies farther than the range counts as if it were a little behind, so that rims stay round; what lies
// nearer is another surface and is left out. Other surfaces stay as they are.
uniform sampler2D surface;   // depth (negative: water; 0: nothing); foam, and 2 more for drops, or body
uniform bool bodies;         // whether other bodies are other surfaces
uniform ivec2 along;         // the axis
uniform float reach;         // how far bumps are smoothed, m
uniform float range;         // greatest difference in depth that belongs to the same surface, m
uniform float rim;           // how far behind it what lies beyond the range counts, m
uniform int taps;            // on each side, at most
uniform float scale;         // pixels a metre at depth 1

out vec4 smoothed;

const float kNothing = 1e30;

// Whether the smooth surface may touch what another pixel shows, but does not go on there.
bool is_other(vec2 there) { return there.x > 0.0 || (!bodies && there.x < 0.0 && there.y >= 2.0); }

// Depth of another pixel beyond `own`. Another body counts as nothing: between the two there is a groove.
float beyond(vec2 there, vec2 own) {
  bool none = there.x == 0.0 || (bodies && there.x < 0.0 && abs(there.y - own.y) > 0.5 / 255.0);
  return none ? kNothing : abs(there.x) + own.x;
}

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(surface, 0) - 1;
  vec2 own = texelFetch(surface, here, 0).xy;
  smoothed = vec4(own, 0.0, 0.0);
  if (own.x >= 0.0 || own.y >= 2.0) return;  // drops are round
  float width = clamp(reach * scale / -own.x, 1.0, 120.0);  // pixels
  int stride = int(ceil(width / float(taps)));
  int count = int(width) / stride;
  float depths = 0.0, weights = 1.0, foams = own.y, foam_weights = 1.0;
  float before = range, behind = range;
  for (int tap = 1; tap <= count; ++tap) {
    float share = float(tap * stride) / width;
    float weight = exp(-2.0 * share * share);
    vec2 a = texelFetch(surface, clamp(here + tap * stride * along, ivec2(0), last), 0).xy;
    vec2 b = texelFetch(surface, clamp(here - tap * stride * along, ivec2(0), last), 0).xy;
    float da = beyond(a, own), db = beyond(b, own);
    // What is no water, and near, is what the water touches: the water ends there without a rim.
    if ((is_other(a) && da <= behind) || (is_other(b) && db <= behind)) continue;
    // A surface before this one hides how it goes on there; its mirror image alone would tilt the mean.
    weight *= (1.0 - smoothstep(0.5 * before, before, -da)) * (1.0 - smoothstep(0.5 * before, before, -db));
    float beyond_a = smoothstep(0.5 * behind, behind, da), beyond_b = smoothstep(0.5 * behind, behind, db);
    depths += weight * (mix(min(da, behind), rim, beyond_a) + mix(min(db, behind), rim, beyond_b));
    weights += 2.0 * weight;
    foams += weight * ((1.0 - beyond_a) * a.y + (1.0 - beyond_b) * b.y);
    foam_weights += weight * (2.0 - beyond_a - beyond_b);
    // The range widens along a slope.
    if (weight > 0.0) {
      float farthest = max(da <= behind ? abs(da) : 0.0, db <= behind ? abs(db) : 0.0);
      before = max(before, range + farthest);
      behind = max(behind, range + farthest);
    }
  }
  smoothed = vec4(own.x - depths / weights, foams / foam_weights, 0.0, 0.0);
}
