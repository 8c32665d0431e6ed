# SPDX-License-Identifier: BSD-3-Clause
# Walks in a substrate folder of Format MCMRSimulator by MCMRSimulator.jl:
#
#     julia tools/benchmarks/simulators/mcmrsimulator.jl FOLDER MILLISECONDS
#
# FOLDER has start positions (StartPositions). For the walkers of each file it tells how many MCMRSimulator.jl finds in that compartment
# at the start and at the end, and their diffusivities (µm²/ms) with standard errors.

using MCMRSimulator
using Statistics: mean, std

folder, milliseconds = ARGS[1], parse(Float64, ARGS[2])
diffusivity, timestep = 2, 0.0002083 # µm²/ms, ms: steps of 0.05 µm

geometry = read_geometry(joinpath(folder, "geometry.json"))
simulation = Simulation([]; geometry=geometry, diffusivity=diffusivity, timestep=timestep, verbose=false)
println("surfaces in each mesh: ", [MCMRSimulator.nvolumes(g) for g in geometry if g.type.plural == :Mesh])

points(path) = [parse.(Float64, split(line)) for line in eachline(path) if !isempty(strip(line))]
rounded(x) = round(x; digits=3)

for (name, subset) in ("intra" => Subset(inside=true, geometry_index=2), "myelin" => Subset(inside=1), "extra" => Subset(inside=0))
    path = joinpath(folder, "start", "$name.txt")
    isfile(path) || continue
    start = points(path)
    before = Snapshot(start; nsequences=0)
    seconds = @elapsed after = evolve(before, simulation, milliseconds)
    squares = [(MCMRSimulator.position(after[i]) .- start[i]) .^ 2 ./ 2milliseconds for i in 1:length(start)]
    means = [(rounded(mean(x)), rounded(std(x) / sqrt(length(x)))) for x in ([s[axis] for s in squares] for axis in 1:3)]
    inside(snapshot) = length(get_subset(snapshot, simulation, subset))
    println(name, ": ", inside(before), " of ", length(start), " inside, ", inside(after), " after ", milliseconds, " ms (", rounded(seconds), " s); D x ± y ± z ±: ", means)
end
