# The discs that rigid_dem_peer --lammps wrote (without --shear-rate), in Yade (Debian: apt install yade): yade -n -x -j1 yade.py DATA FRICTION SHEAR STEPS
# Prints kinetic energy per disc, stresses, Z, seconds of the loop by the clock and of the processor.
import sys
import time
from math import pi

from yade import *
from yade import utils

data, friction, shear, steps = sys.argv[-4], float(sys.argv[-3]), float(sys.argv[-2]), int(sys.argv[-1])
words = [line.split() for line in open(data)]
count = int(words[2][0])
width = next(float(w[1]) for w in words if w[2:] == ["xlo", "xhi"])
height = next(float(w[1]) for w in words if w[2:] == ["ylo", "yhi"])
atoms = next(k for k, w in enumerate(words) if w[:1] == ["Atoms"]) + 2
velocities = next(k for k, w in enumerate(words) if w[:1] == ["Velocities"]) + 2

O.periodic = True
O.cell.setBox(width, height, 4.0)
material = O.materials.append(
    FrictMat(young=1e5, poisson=0.5, density=1.0, frictionAngle=atan(friction)))
for w in words[atoms:atoms + count]:
    radius = 0.5 * float(w[2])
    disc = utils.sphere((float(w[4]), float(w[5]), 2.0), radius, material=material)
    disc.state.mass = pi * radius**2
    disc.state.inertia = Vector3(1, 1, 1) * 0.5 * disc.state.mass * radius**2
    disc.state.blockedDOFs = "zXY"
    O.bodies.append(disc)
for w in words[velocities:velocities + count]:
    O.bodies[int(w[0]) - 1].state.vel = Vector3(float(w[1]), float(w[2]), 0.0)
if shear:  # gives its flow to the discs
    O.cell.velGrad = Matrix3(0, shear, 0, 0, 0, 0, 0, 0, 0)

O.dt = 1e-4
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.05),  # for each of two: a skin of 0.1
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(algo="val", val=1e5), ks=MatchMaker(algo="val", val=5e4))],
        [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, 0)),
]
O.run(1, True)  # forces of the start; each further step moves the discs first
began, began_cpu = time.time(), time.process_time()
O.run(steps, True)
seconds, cpu_seconds = time.time() - began, time.process_time() - began_cpu
# Stress of a cell of unit depth; its sign is tension positive.
stress = -utils.getStress(width * height)
contacts = sum(1 for i in O.interactions if i.isReal)
def energy(disc):
    flow = shear * disc.state.pos[1]
    translation = disc.state.mass * ((disc.state.vel[0] - flow)**2 + disc.state.vel[1]**2)
    return 0.5 * (translation + disc.state.inertia[2] * disc.state.angVel[2]**2)


kinetic = sum(energy(b) for b in O.bodies) / count
print("yade,%d,%d,%.10g,%.10g,%.10g,%.8f,%.4f,%.4f" %
      (count, steps, kinetic, stress[0, 0], stress[1, 1], 2.0 * contacts / count, seconds, cpu_seconds), flush=True)
sys.stdout.flush()
O.exitNoBacktrace()
