// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/attraction_builder.h"

namespace hooke::scene {

Attraction build_attraction(const Json& json) {
  Attraction attraction;
  attraction.constant = json.at("G").get<double>();
  attraction.softening = json.at("softening").get<double>();
  if (json.at("method") == "direct") attraction.method = Attraction::Method::direct;
  if (json.at("method") == "tree") attraction.method = Attraction::Method::tree;
  attraction.accuracy = json.at("accuracy").get<double>();
  attraction.exact = json.at("exact").get<bool>();
  return attraction;
}

}  // namespace hooke::scene
