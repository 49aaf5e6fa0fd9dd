// Shading of our own: the studio that metal reflects, the ground, and ghosts.

import * as THREE from "three";

// A studio as a formula instead of a picture: nothing to load or to filter, and cheap where the graphics are software.
// Direction in world axes; a soft box overhead, a strip on either side, a bright horizon, a darker floor.
const STUDIO = `
  uniform float studio, outline;
  vec3 studioLight(vec3 to, float rough) {
    float soft = 0.08 + 0.75 * rough;
    float light = mix(0.34, 0.78, smoothstep(-0.25 - soft, 0.15 + soft, to.z));
    light = mix(light, 0.5, smoothstep(0.2, 0.9, to.z));
    float above = dot(to, vec3(0.148, -0.297, 0.943));
    light += 2.6 / (1.0 + 5.0 * rough) * smoothstep(0.86 - soft, 0.86 + 0.5 * soft, above);
    float aside = abs(dot(to, vec3(0.342, 0.94, 0.0)));
    light += 1.1 / (1.0 + 4.0 * rough) * smoothstep(0.9 - soft, 0.9 + 0.5 * soft, aside) * smoothstep(-0.2, 0.15, to.z);
    return light * mix(vec3(0.97, 0.98, 1.0), vec3(1.0, 0.99, 0.97), 0.5 + 0.5 * to.x);
  }
  vec3 toWorld(vec3 direction) {
    return normalize((vec4(direction, 0.0) * viewMatrix).xyz);
  }`;

export const studio = { value: 0.7 }; // its strength, the same everywhere
export const outline = { value: 0 }; // light from behind, that lifts dark parts off a dark page

// three's standard material, lit by the sun and this studio.
export function solid({ color, opacity, roughness, metalness }) {
  const material = new THREE.MeshStandardMaterial({ color: lifted(color), opacity, roughness, metalness, transparent: opacity < 1 });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, { studio, outline });
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `${STUDIO}\nvoid main() {`)
      .replace(
        "#include <lights_fragment_maps>",
        `#include <lights_fragment_maps>
        vec3 upwards = toWorld(geometryNormal);
        iblIrradiance += PI * studio * mix(0.42, 0.85, 0.5 + 0.5 * upwards.z);
        vec3 mirrored = toWorld(reflect(-geometryViewDir, geometryNormal));
        radiance += studio * studioLight(mirrored, material.roughness);
        float facing = saturate(dot(geometryNormal, geometryViewDir));
        totalEmissiveRadiance += outline * pow(1.0 - facing, 3.0) * (0.35 + 0.65 * smoothstep(-0.6, 0.8, upwards.z));`,
      );
  };
  material.customProgramCacheKey = () => "studio";
  return material;
}

// Black reflects something too: what is given as almost black keeps its form this way.
function lifted(color) {
  const given = new THREE.Color(color);
  return given.lerp(LEAST, 1 - Math.min(1, Math.max(given.r, given.g, given.b) / LEAST.r));
}

const LEAST = new THREE.Color("#2a2e33");

export const groundShader = {
  vertexShader: `
    #include <common>
    #include <shadowmap_pars_vertex>
    varying vec2 place;
    void main() {
      #include <beginnormal_vertex>
      #include <defaultnormal_vertex>
      #include <begin_vertex>
      #include <project_vertex>
      #include <worldpos_vertex>
      #include <shadowmap_vertex>
      place = position.xy;
    }`,
  fragmentShader: `
    #include <common>
    #include <packing>
    #include <lights_pars_begin>
    #include <shadowmap_pars_fragment>
    uniform vec3 ground, line;
    uniform float cell, radius, shade;
    uniform vec2 centre;
    varying vec2 place;

    float grid(float size, float width) {
      vec2 at = place / size;
      vec2 step = fwidth(at);
      vec2 away = abs(fract(at - 0.5) - 0.5) / max(step, 1e-6);
      vec2 lines = clamp(width - away, 0.0, 1.0) * clamp(1.0 - 2.5 * step, 0.0, 1.0);
      return max(lines.x, lines.y);
    }

    // a disc of samples; where the first few agree, that is all
    float lit() {
      #if defined(USE_SHADOWMAP) && NUM_DIR_LIGHT_SHADOWS > 0
        vec3 at = vDirectionalShadowCoord[0].xyz / vDirectionalShadowCoord[0].w;
        if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
        at.z -= 0.0006;
        float wide = 7.0 / directionalLightShadows[0].shadowMapSize.x;
        float sum = 0.0;
        for (int i = 0; i < 6; i++) {
          float angle = 1.0472 * float(i);
          sum += texture(directionalShadowMap[0], vec3(at.xy + 1.1 * wide * vec2(cos(angle), sin(angle)), at.z));
        }
        if (sum < 0.001 || sum > 5.999) return sum / 6.0;
        sum = 0.0;
        for (int i = 0; i < 24; i++) {
          float angle = 2.39996 * float(i);
          float far = sqrt((float(i) + 0.5) / 24.0) * wide;
          sum += texture(directionalShadowMap[0], vec3(at.xy + far * vec2(cos(angle), sin(angle)), at.z));
        }
        return sum / 24.0;
      #else
        return 1.0;
      #endif
    }

    void main() {
      float shown = 1.0 - smoothstep(0.25, 1.0, length(place - centre) / radius);
      if (shown <= 0.0) discard;
      float lines = max(0.45 * grid(cell, 1.1), grid(2.0 * cell, 1.3));
      vec3 colour = mix(ground, line, lines);
      colour *= 1.0 - shade * (1.0 - lit());
      gl_FragColor = vec4(colour, shown);
      #include <colorspace_fragment>
    }`,
};

export const ghostShader = {
  vertexShader: `
    varying vec3 direction, towards;
    void main() {
      vec4 there = modelViewMatrix * vec4(position, 1.0);
      direction = normalMatrix * normal;
      towards = -there.xyz;
      gl_Position = projectionMatrix * there;
    }`,
  fragmentShader: `
    uniform vec3 colour;
    uniform float strength;
    varying vec3 direction, towards;
    void main() {
      float edge = 1.0 - abs(dot(normalize(direction), normalize(towards)));
      gl_FragColor = vec4(colour, strength * (0.22 + 0.7 * edge * edge));
      #include <colorspace_fragment>
    }`,
};
