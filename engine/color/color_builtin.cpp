// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/color/color_builtin.h"

namespace keyline {

// Every matrix and curve is one that OpenColorIO builds in, so that no figure is typed twice and nothing is
// read from disk.  The reference is linear Rec.709 rather than ACES2065-1: most conversions start or end
// there, and then go through one matrix instead of two.
const char* const kBuiltinColorConfig = R"yaml(ocio_profile_version: 2.1
name: keyline
description: The config compiled into Keyline.
environment: {}
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

roles:
  scene_linear: Linear Rec.709 (sRGB)
  data: Raw

file_rules:
  - !<Rule> {name: Default, colorspace: scene_linear}

displays:
  sRGB - Display:
    - !<View> {name: ACES 1.0 - SDR Video, view_transform: ACES 1.0 - SDR Video, display_colorspace: sRGB - Display}
    - !<View> {name: Un-tone-mapped, view_transform: Un-tone-mapped, display_colorspace: sRGB - Display}
    - !<View> {name: Raw, colorspace: Raw}
  Rec.1886 Rec.709 - Display:
    - !<View> {name: ACES 1.0 - SDR Video, view_transform: ACES 1.0 - SDR Video, display_colorspace: Rec.1886 Rec.709 - Display}
    - !<View> {name: Un-tone-mapped, view_transform: Un-tone-mapped, display_colorspace: Rec.1886 Rec.709 - Display}
    - !<View> {name: Raw, colorspace: Raw}
  P3-D65 - Display:
    - !<View> {name: ACES 1.0 - SDR Video, view_transform: ACES 1.0 - SDR Video, display_colorspace: P3-D65 - Display}
    - !<View> {name: Un-tone-mapped, view_transform: Un-tone-mapped, display_colorspace: P3-D65 - Display}
    - !<View> {name: Raw, colorspace: Raw}

view_transforms:
  - !<ViewTransform>
    name: Un-tone-mapped
    description: The scene's colours as they are; what is brighter than the display stays brighter.
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_CIE-XYZ-D65_BFD}

  - !<ViewTransform>
    name: ACES 1.0 - SDR Video
    description: The ACES 1.0 rendering for a display of 100 nits.
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD, direction: inverse}
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
        - !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}

display_colorspaces:
  - !<ColorSpace>
    name: sRGB - Display
    aliases: [srgb_display]
    description: What an sRGB display takes.
    encoding: sdr-video
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}

  - !<ColorSpace>
    name: Rec.1886 Rec.709 - Display
    aliases: [rec1886_rec709_display]
    description: What a television of Rec.709 with the curve of Rec.1886 takes.
    encoding: sdr-video
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709}

  - !<ColorSpace>
    name: P3-D65 - Display
    aliases: [p3d65_display]
    description: What a cinema projector with the white of D65 takes, of gamma 2.6.
    encoding: sdr-video
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_G2.6-P3-D65}

colorspaces:
  - !<ColorSpace>
    name: Linear Rec.709 (sRGB)
    aliases: [linear, lin_rec709, lin_srgb, lin_rec709_srgb, Utility - Linear - Rec.709, Utility - Linear - sRGB]
    description: Scene-linear with the primaries of Rec.709 and the white of D65.
    encoding: scene-linear

  - !<ColorSpace>
    name: ACEScg
    aliases: [lin_ap1, ACES - ACEScg]
    description: Scene-linear with the AP1 primaries.
    encoding: scene-linear
    to_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: ACES2065-1
    aliases: [lin_ap0, aces, ACES - ACES2065-1]
    description: Scene-linear with the AP0 primaries, for exchange.
    encoding: scene-linear
    to_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: sRGB - Texture
    aliases: [sRGB, srgb_tx, Utility - sRGB - Texture, Input - Generic - sRGB - Texture]
    description: The curve of sRGB over the primaries of Rec.709, as pictures for the screen have it.
    encoding: sdr-video
    to_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}

  - !<ColorSpace>
    name: Gamma 2.2 Rec.709 - Texture
    aliases: [g22_rec709_tx, g22_rec709, Utility - Gamma 2.2 - Rec.709 - Texture]
    description: The power of 2.2 over the primaries of Rec.709.
    encoding: sdr-video
    to_scene_reference: !<ExponentTransform> {value: 2.2, style: pass_thru}

  - !<ColorSpace>
    name: Gamma 2.4 Rec.709 - Texture
    aliases: [g24_rec709_tx, g24_rec709]
    description: The power of 2.4 over the primaries of Rec.709, as television has it.
    encoding: sdr-video
    to_scene_reference: !<ExponentTransform> {value: 2.4, style: pass_thru}

  - !<ColorSpace>
    name: ACEScct
    aliases: [acescct_ap1, ACES - ACEScct]
    description: ACEScg by its logarithm, with a toe; for grading.
    encoding: log
    to_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScct_to_ACES2065-1}
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: ACEScc
    aliases: [acescc_ap1, ACES - ACEScc]
    description: ACEScg by its logarithm; for decisions made in it.
    encoding: log
    to_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScc_to_ACES2065-1}
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: Raw
    aliases: [Utility - Raw]
    description: Data, never converted.
    isdata: true

named_transforms:
  - !<NamedTransform>
    name: sRGB - Curve
    aliases: [srgb_crv]
    description: The curve of sRGB by itself, whatever the primaries; forward makes linear of it.
    encoding: sdr-video
    transform: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055}

  - !<NamedTransform>
    name: Rec.1886 - Curve
    aliases: [rec1886_crv]
    description: The curve of Rec.1886 by itself, whatever the primaries; forward makes linear of it.
    encoding: sdr-video
    transform: !<ExponentTransform> {value: 2.4, style: pass_thru}
)yaml";

}  // namespace keyline
