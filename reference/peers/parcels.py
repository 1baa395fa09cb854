"""The case of MPPICInterFoam: interFoam's, with the bed of a scene as parcels of many beads each.

The models are those of OpenFOAM's own example (multiphase/MPPICInterFoam/twoPhasePachuka) but for the drag, which is
Ergun's below and Wen and Yu's above a void fraction of 0.8 as in the scene, and the stress, whose packing is the scene's
greatest. The program has no friction between grains and no gate: the column is let go at once.

It can only inject parcels during a step, which would push as much fluid out of their way within that step. They are
therefore injected in a step of its own, and the run starts from the parcels that this step leaves behind.
"""
import math
import random
import shutil

from . import openfoam_case
from .openfoam_case import CaseError, foam_file, vector

STRESS = {"pSolid": 10.0, "beta": 2.0, "eps": 1e-2}  # Harris & Crighton; those of the example are 5, 2 and 1e-2


CLOUD = "constant/kinematicCloudProperties"
FILLING_STEP = 1e-9  # [s]
LONGEST_STEP = 1e-4  # longer ones, which the Courant numbers allow, shoot parcels out of the bed [s]


def fill(directory, run_program):
    """Leaves the parcels in the case's time 0; `run_program(directory)` runs MPPICInterFoam, after blockMesh."""
    filling = directory / "filling"
    shutil.copytree(directory / "0", filling / "0")
    shutil.copytree(directory / "constant", filling / "constant")
    shutil.copytree(directory / "system", filling / "system")
    shutil.move(filling / (CLOUD + ".filling"), filling / CLOUD)
    foam_file(filling, "system/controlDict", "dictionary", f"""application MPPICInterFoam;
startFrom startTime; startTime 0; stopAt endTime; endTime {FILLING_STEP}; deltaT {FILLING_STEP};
writeControl timeStep; writeInterval 1; writeFormat ascii; writePrecision 12; timePrecision 12; runTimeModifiable no;
maxCo 1e9; maxAlphaCo 1e9; maxDeltaT {FILLING_STEP}; adjustTimeStep no;
""")
    run_program(filling)
    filled = filling / f"{FILLING_STEP:g}"
    shutil.copytree(filled / "lagrangian", directory / "0/lagrangian")
    shutil.copy(filled / "alphac", directory / "0/alphac")  # for the output; the program makes its own


def positions(box, spacing, per_cell, flat, seed=1):
    """Parcels at random, one in each brick; `per_cell` bricks a cell, so that no cell starts fuller than another."""
    directions = 2 if flat else 3
    along = max(1, round(per_cell ** (1.0 / directions)))
    extent = [b - a for a, b in zip(*box)]
    numbers = [max(1, round(along * length / edge)) for length, edge in zip(extent, spacing)][:directions] + [1] * (3 - directions)
    draw = random.Random(seed)
    found = []
    for k in range(numbers[2]):
        for j in range(numbers[1]):
            for i in range(numbers[0]):
                shares = [(n + draw.random()) / number for n, number in zip((i, j, k), numbers)]
                if flat:
                    shares[2] = 0.5
                found.append([low + share * length for low, share, length in zip(box[0], shares, extent)])
    return found


def bed_box(tank):
    bed = tank.scene["bed"]
    low = [bed.get("x", 0.0), bed.get("y", 0.0), bed.get("z", 0.0)]
    width = tank.size[2] if tank.flat else bed.get("width", tank.size[2])
    return low, [low[0] + bed["length"], low[1] + bed["height"], low[2] + width]


def write_case(directory, tank, per_cell):
    """Gives back what the record states of the parcels."""
    scene = tank.scene
    if "bed" not in scene:
        raise CaseError(f"{tank.name}: there are no grains")
    openfoam_case.write_mesh(directory, tank)
    openfoam_case.write_fields(directory, tank)
    openfoam_case.write_properties(directory, tank)
    openfoam_case.write_control(directory, tank, "MPPICInterFoam", 0.3, LONGEST_STEP)
    box = bed_box(tank)
    parcels = positions(box, tank.spacing, per_cell, tank.flat)
    solid, d = scene["solid"], scene["solid"]["diameter"]
    volume = scene["bed"]["solid_fraction"] * math.prod(b - a for a, b in zip(*box))
    beads = volume / (math.pi / 6 * d ** 3)
    packed = scene["contact"]["solid_fraction_max"]
    foam_file(directory, "constant/parcelPositions", "vectorField",
              "(\n" + "\n".join(vector(p) for p in parcels) + "\n)\n")
    stress = " ".join(f"{name} {value};" for name, value in STRESS.items())
    time_scale = f"type %s; alphaPacked {packed}; e {solid['restitution']};"
    walls = "".join(
        f"            {side} {{ type rebound; e {solid['restitution']}; mu {solid['friction']}; }}\n"
        for side in openfoam_case.SIDES if tank.side(side) in ("no-slip", "slip"))
    outlet = "".join(f"            {side} {{ type escape; }}\n" for side in openfoam_case.SIDES if tank.side(side) == "open")
    injection = f"""
        bed
        {{
            type manualInjection; massTotal {volume * solid['density']:.10g}; SOI 0;
            parcelBasisType fixed; nParticle {beads / len(parcels):.10g};
            positionsFile "parcelPositions"; U0 (0 0 0);
            sizeDistribution {{ type fixedValue; fixedValueDistribution {{ value {d}; }} }}
        }}
"""
    cloud = f"""solution
{{
    active true; coupled true; transient yes; cellValueSourceCorrection no; maxCo 0.3;
    interpolationSchemes {{ rho cell; U cellPoint; mu cell; gradAlpha cellPoint; }}
    averagingMethod basic;
    integrationSchemes {{ U Euler; }}
    sourceTerms {{ schemes {{ U semiImplicit 0.8; }} }}
}}
constantProperties {{ rho0 {solid['density']}; alphaMax {packed}; }}
subModels
{{
    particleForces {{ ErgunWenYuDrag {{ alphac alphac; }} gravity; }}
    injectionModels {{ INJECTION }}
    dispersionModel none;
    patchInteractionModel localInteraction;
    localInteractionCoeffs
    {{
        patches
        (
{walls}{outlet}        );
    }}
    heatTransferModel none; surfaceFilmModel none; stochasticCollisionModel none; radiation off;
    packingModel implicit;
    implicitCoeffs
    {{
        alphaMin 0.001; rhoMin 1.0; applyGravity false; applyLimiting false;
        particleStressModel {{ type HarrisCrighton; alphaPacked {packed}; {stress} }}
    }}
    dampingModel relaxation;
    relaxationCoeffs {{ timeScaleModel {{ {time_scale % 'nonEquilibrium'} }} }}
    isotropyModel stochastic;
    stochasticCoeffs {{ timeScaleModel {{ {time_scale % 'isotropic'} }} }}
}}
cloudFunctions {{}}
"""
    foam_file(directory, CLOUD + ".filling", "dictionary", cloud.replace("INJECTION", injection))
    foam_file(directory, CLOUD, "dictionary", cloud.replace("INJECTION", ""))
    foam_file(directory, "system/fvSchemes", "dictionary", openfoam_case.SCHEMES % (
        "    div(rhoPhi,U) Gauss upwind;\n    div((((alphac*rho)*nuEff)*dev2(T(grad(U))))) Gauss linear;\n"
        "    div(phiGByA,kinematicCloud:alpha) Gauss linear;"))
    foam_file(directory, "system/fvSolution", "dictionary", openfoam_case.SOLUTION % (
        "    kinematicCloud:alpha { solver PCG; preconditioner DIC; tolerance 1e-6; relTol 0.1; }\n"))
    return {"parcels": len(parcels), "beads_per_parcel": beads / len(parcels), "release": "instant", "friction": "none",
            "stress": {"alphaPacked": packed, **STRESS}}
