-- SPDX-License-Identifier: Apache-2.0
-- Keeps the score of the hunt. The prey starts slow and gets faster with each capture; one that is not
-- captured for long enough has won, and its speed is what the hunt is about.
local kFirst_speed_mps = 0.2
local kFaster_by_mps = 0.05
local kCaptured_m = 0.485 -- between the centres: a gap of 0.2 m between the outlines
local kWins_after_s = 90
local kCorners = {{0.6, 0.6}, {5.4, 0.6}, {5.4, 4.4}, {0.6, 4.4}}

memory.captures = 0
memory.since_s = 0

local function speed_mps()
  return kFirst_speed_mps + kFaster_by_mps * memory.captures
end

local function start_again()
  local farthest = kCorners[1]
  for i = 2, #kCorners do
    if distance("predator", kCorners[i]) > distance("predator", farthest) then farthest = kCorners[i] end
  end
  place{robot = "prey", point = farthest}
end

function on_start()
  set{robot = "prey", key = "program.max_speed_mps", value = speed_mps()}
end

function on_step(t)
  if distance("predator", "prey") <= kCaptured_m then
    local took_s = t - memory.since_s
    memory.captures = memory.captures + 1
    memory.since_s = t
    mark(string.format("capture %d after %.1f s; the next prey runs at %.2f m/s", memory.captures, took_s, speed_mps()))
    set{robot = "prey", key = "program.max_speed_mps", value = speed_mps()}
    start_again()
  elseif t - memory.since_s > kWins_after_s then
    finish("success", string.format("%d captures; a prey of %.2f m/s gets away", memory.captures, speed_mps()))
  end
end
