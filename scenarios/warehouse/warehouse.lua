-- SPDX-License-Identifier: Apache-2.0
-- Gives each robot of the warehouse its next place in its aisle, and counts what has been fetched. An aisle is
-- a loop: up, across, down, across. A place in it is the way along the loop [m].
local kAisles, kRows = 25, 10
local kSouth_m, kNorth_m, kAcross_m, kApart_m = 2, 42, 1.6, 4
local kLane_m = kNorth_m - kSouth_m
local kLoop_m = 2 * (kLane_m + kAcross_m)
local kPick_s = 3
local kLooks = 10 -- one robot in ten is looked at in a step
local kReached_m = 0.3

memory.fetched = 0
memory.way = {}   -- per robot: where its goal is
memory.until_s = {} -- per robot: until when it picks; -1: it is on its way

local function point(aisle, way_m)
  local x0 = kApart_m * aisle
  way_m = way_m % kLoop_m
  if way_m <= kLane_m then return {x0, kSouth_m + way_m} end
  way_m = way_m - kLane_m
  if way_m <= kAcross_m then return {x0 + way_m, kNorth_m} end
  way_m = way_m - kAcross_m
  if way_m <= kLane_m then return {x0 + kAcross_m, kNorth_m - way_m} end
  return {x0 + kAcross_m - (way_m - kLane_m), kSouth_m}
end

local kCorners = {0, kLane_m, kLane_m + kAcross_m, 2 * kLane_m + kAcross_m}

-- The corners between, and the goal.
local function path_to(aisle, from_m, to_m)
  local points = {}
  for lap = 0, 1 do
    for _, corner in ipairs(kCorners) do
      local at = corner + lap * kLoop_m
      if at > from_m and at < to_m then points[#points + 1] = point(aisle, at) end
    end
  end
  points[#points + 1] = point(aisle, to_m)
  return points
end

-- Of the lanes alone, since no goods lie where robots turn.
local function next_way(from_m)
  local to = from_m + 4 + 30 * random()
  for _, corner in ipairs({kLane_m, 2 * kLane_m + kAcross_m, kLoop_m + kLane_m}) do
    if to > corner - 1.5 and to < corner + kAcross_m + 1.5 then return corner + kAcross_m + 1.5 end
  end
  return to
end

local function robot(i)
  return i <= kAisles * kRows and "up-" .. i or "down-" .. i - kAisles * kRows
end

local function aisle(i)
  return (i - 1) % kAisles
end

local function send(i)
  local from = memory.way[i]
  local to = next_way(from)
  local points = path_to(aisle(i), from, to)
  if #points == 1 then
    goal{robot = robot(i), point = points[1]}
  else
    path{robot = robot(i), points = points}
  end
  memory.way[i] = to % kLoop_m
  memory.until_s[i] = -1
end

function on_start()
  for i = 1, 2 * kAisles * kRows do
    local along = kApart_m * (((i - 1) // kAisles) % kRows + 1)
    memory.way[i] = i <= kAisles * kRows and along - kSouth_m or kLane_m + kAcross_m + kNorth_m - along
    memory.until_s[i] = 0
  end
  memory.turn = 0
  memory.minutes = 0
end

function on_step(t)
  memory.turn = memory.turn % kLooks + 1
  for i = memory.turn, 2 * kAisles * kRows, kLooks do
    if memory.until_s[i] < 0 then
      if distance(robot(i), point(aisle(i), memory.way[i])) < kReached_m then
        memory.fetched = memory.fetched + 1
        memory.until_s[i] = t + kPick_s
      end
    elseif t >= memory.until_s[i] then
      send(i)
    end
  end
  if t >= 60 * (memory.minutes + 1) then
    memory.minutes = memory.minutes + 1
    mark(string.format("%d goals, %.0f per hour", memory.fetched, memory.fetched / t * 3600))
  end
end
