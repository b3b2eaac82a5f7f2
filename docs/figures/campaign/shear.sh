# Simple shear at constant normal stress: dense and loose samples, three seeds each, and a smaller SDEM sample of each.
document_shear=scenarios/shear/README.md
seeds_shear="1 2 3"

plan_shear() {
    local state seed
    for state in dense loose; do
        for seed in $seeds_shear; do
            simulate rigid_dem "shear-$state-$seed" shear/$state.toml random.seed=$seed
        done
        simulate sdem "shear-$state-sdem" shear/$state.toml packing.count=200 loading.1.inertial_number=1e-3
        simulate rigid_dem "shear-$state-200" shear/$state.toml packing.count=200 loading.1.inertial_number=1e-3
    done
}
