"""A resolved case of ours as a case of OpenFOAM's interFoam or MPPICInterFoam.

One uniform block in OpenFOAM's own cell order, the liquid written cell by cell with its exact share, walls as the scene
has them. What these programs do not have is left out and said so: subgrid viscosity, gates, moving or periodic walls.
"""
import itertools
import math

from granvof_files import toml_in

HEADER = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"
SIDES = ("left", "right", "bottom", "top", "front", "back")
CORNERS = {  # of the faces, in the block's own numbering of its corners
    "left": "(0 4 7 3)", "right": "(1 2 6 5)", "bottom": "(0 1 5 4)", "top": "(3 7 6 2)", "front": "(0 3 2 1)", "back": "(4 5 6 7)"}
SLICE = 0.01  # thickness of the one layer of cells of a scene in two dimensions [m], unless given


class CaseError(Exception):
    """What the peer cannot compute, in one line."""


def vector(values):
    return "(" + " ".join(f"{value:.12g}" for value in values) + ")"


class Tank:
    """Box, grid and liquid of a scene, from the text that `granvof check` prints."""

    def __init__(self, resolved, depth=SLICE):
        self.scene = scene = toml_in(resolved)
        self.name = scene["scene"]["name"]
        self.flat = scene["scene"]["dimensions"] == 2
        size, grid = list(scene["tank"]["size"]), scene["grid"]
        self.size = size[:2] + [depth if self.flat else size[2]]
        spacing = [grid["dx"], grid["dy"], depth if self.flat else grid.get("dz", grid["dx"])]
        self.cells = [round(length / edge) for length, edge in zip(self.size, spacing)]
        self.spacing = [length / n for length, n in zip(self.size, self.cells)]
        self.gravity = scene["tank"]["gravity"]
        angle = math.radians(scene["tank"].get("inclination", 0))
        self.pull = [self.gravity * math.sin(angle), -self.gravity * math.cos(angle), 0]

    def side(self, name):
        """'no-slip', 'slip', 'open', or 'empty' for the faces across a slice."""
        if self.flat and name in ("front", "back"):
            return "empty"
        wall = self.scene["walls"][name]
        kind = wall if isinstance(wall, str) else wall["fluid"]
        if kind not in ("no-slip", "slip", "open"):
            raise CaseError(f"{self.name}: the wall '{name}' is {kind}, allowed: no-slip, slip, open")
        return kind

    def boxes(self):
        """Lower and upper corners of the liquid."""
        liquid = self.scene["liquid"]
        found = []
        if "level" in liquid:
            found.append(((0, 0, 0), (self.size[0], liquid["level"], self.size[2])))
        if "box" in liquid:
            low, extent = list(liquid["box"]["origin"]), list(liquid["box"]["size"])
            if self.flat:
                low, extent = low[:2] + [0.0], extent[:2] + [self.size[2]]
            found.append((tuple(low), tuple(a + b for a, b in zip(low, extent))))
        return found

    def liquid_shares(self):
        """Liquid share of every cell, x fastest: the order of blockMesh."""
        def share(box, cell):
            result = 1.0
            for low, high, index, edge in zip(*box, cell, self.spacing):
                result *= max(0.0, min((index + 1) * edge, high) - max(index * edge, low)) / edge
            return result

        boxes = self.boxes()
        return [max((share(box, (i, j, k)) for box in boxes), default=0.0)
                for k, j, i in itertools.product(*(range(n) for n in reversed(self.cells)))]


def foam_file(directory, name, kind, body):
    path = directory / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER.format(kind=kind, name=path.name) + body)


def field(tank, internal, dimensions, by_kind):
    """Text of a field; `by_kind` gives the boundary condition of each kind of side."""
    text = f"dimensions {dimensions};\ninternalField {internal};\nboundaryField\n{{\n"
    for side in SIDES:
        kind = tank.side(side)
        text += f"    {side} {{ {'type empty;' if kind == 'empty' else by_kind[kind]} }}\n"
    return text + "}\n"


def write_mesh(directory, tank):
    x, y, z = tank.size
    corners = [(0, 0, 0), (x, 0, 0), (x, y, 0), (0, y, 0), (0, 0, z), (x, 0, z), (x, y, z), (0, y, z)]
    patches = "".join(
        f"    {side} {{ type {dict(empty='empty', open='patch').get(tank.side(side), 'wall')}; faces ({CORNERS[side]}); }}\n"
        for side in SIDES)
    foam_file(directory, "system/blockMeshDict", "dictionary",
              f"scale 1;\nvertices ({' '.join(vector(c) for c in corners)});\n"
              f"blocks ( hex (0 1 2 3 4 5 6 7) ({' '.join(map(str, tank.cells))}) simpleGrading (1 1 1) );\n"
              f"boundary\n(\n{patches});\n")


def write_fields(directory, tank):
    shares = tank.liquid_shares()
    numbers = "\n".join(f"{share:.10g}" for share in shares)
    foam_file(directory, "0/alpha.water", "volScalarField", field(
        tank, f"nonuniform List<scalar>\n{len(shares)}\n(\n{numbers}\n)", "[0 0 0 0 0 0 0]",
        {"slip": "type zeroGradient;", "no-slip": "type zeroGradient;",
         "open": "type inletOutlet; inletValue uniform 0; value uniform 0;"}))
    foam_file(directory, "0/U", "volVectorField", field(
        tank, "uniform (0 0 0)", "[0 1 -1 0 0 0 0]",
        {"slip": "type slip;", "no-slip": "type fixedValue; value uniform (0 0 0);",
         "open": "type pressureInletOutletVelocity; value uniform (0 0 0);"}))
    wall = "type fixedFluxPressure; value uniform 0;"
    foam_file(directory, "0/p_rgh", "volScalarField", field(
        tank, "uniform 0", "[1 -1 -2 0 0 0 0]",
        {"slip": wall, "no-slip": wall, "open": "type totalPressure; p0 uniform 0; value uniform 0;"}))


def write_properties(directory, tank):
    gas, liquid = tank.scene["gas"], tank.scene["liquid"]

    def phase(name, p):
        return f"{name} {{ transportModel Newtonian; nu {p['viscosity'] / p['density']:.12g}; rho {p['density']:.12g}; }}\n"

    foam_file(directory, "constant/g", "uniformDimensionedVectorField",
              f"dimensions [0 1 -2 0 0 0 0];\nvalue ({tank.pull[0]:.12g} {tank.pull[1]:.12g} 0);\n")
    foam_file(directory, "constant/transportProperties", "dictionary",
              "phases (water air);\n" + phase("water", liquid) + phase("air", gas) + "sigma 0;\n")
    foam_file(directory, "constant/turbulenceProperties", "dictionary", "simulationType laminar;\n")


def write_control(directory, tank, program, courant, longest=math.inf):
    """`longest` bounds the time step [s], as the interval of the output does."""
    output = tank.scene["output"]["series_interval"] * time_unit(tank)
    foam_file(directory, "system/controlDict", "dictionary", f"""application {program};
startFrom startTime; startTime 0; stopAt endTime; endTime {tank.scene['time']['end'] * time_unit(tank):.12g};
deltaT 1e-5; adjustTimeStep yes; maxCo {courant}; maxAlphaCo {courant}; maxDeltaT {min(output, longest):.12g};
writeControl adjustableRunTime; writeInterval {output:.12g};
writeFormat ascii; writePrecision 8; writeCompression off; timeFormat general; timePrecision 8; runTimeModifiable no;
""")


def time_unit(tank):
    """Seconds per unit of the scene's times."""
    if tank.scene["time"]["unit"] == "column":
        return math.sqrt(tank.scene["bed"]["height"] / tank.gravity)
    return 1.0


SCHEMES = """ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
%s
    div(phi,alpha) Gauss vanLeer;
    div(phirb,alpha) Gauss linear;
}
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
"""

SOLUTION = """solvers
{
    "alpha.water.*"
    {
        nAlphaCorr 2; nAlphaSubCycles 1; cAlpha 1; MULESCorr yes; nLimiterIter 5;
        solver smoothSolver; smoother symGaussSeidel; tolerance 1e-9; relTol 0;
    }
    "pcorr.*" { solver PCG; preconditioner DIC; tolerance 1e-6; relTol 0; }
    p_rgh { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 0.01; }
    p_rghFinal { $p_rgh; relTol 0; }
    "U.*" { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; }
%s}
PIMPLE { momentumPredictor no; nOuterCorrectors 1; nCorrectors 3; nNonOrthogonalCorrectors 0; }
"""


def write_interfoam(directory, tank):
    """The case of interFoam, with the schemes of OpenFOAM's own dam break example."""
    if "bed" in tank.scene or "gate" in tank.scene:
        raise CaseError(f"{tank.name}: interFoam knows neither grains nor gates")
    write_mesh(directory, tank)
    write_fields(directory, tank)
    write_properties(directory, tank)
    write_control(directory, tank, "interFoam", 0.3)
    foam_file(directory, "system/fvSchemes", "dictionary", SCHEMES % (
        "    div(rhoPhi,U) Gauss linearUpwind grad(U);\n    div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;"))
    foam_file(directory, "system/fvSolution", "dictionary", SOLUTION % "")
