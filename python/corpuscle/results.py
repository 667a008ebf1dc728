"""Meshes and particles at one time, as numpy arrays."""
import dataclasses
import pathlib
import xml.etree.ElementTree

import numpy


@dataclasses.dataclass
class Surface:
    """Points [m], triangles (indices of points, shape (n, 3); none of particles), arrays by name, field data (TimeValue [s], strain)."""

    points: numpy.ndarray
    triangles: numpy.ndarray
    pointData: dict
    cellData: dict
    fieldData: dict

    @property
    def time(self):
        return float(self.fieldData["TimeValue"][0]) if "TimeValue" in self.fieldData else 0.0

    @property
    def strain(self):
        return float(self.fieldData["strain"][0]) if "strain" in self.fieldData else numpy.nan

    @property
    def area(self):
        """Of all triangles [m^2]."""
        return float(numpy.linalg.norm(self._products(), axis=1).sum() / 2)

    @property
    def volume(self):
        """Enclosed by all triangles [m^3], whose normals point outward."""
        return float(numpy.einsum("ij,ij->", self.points[self.triangles[:, 0]], self._products()) / 6)

    def _products(self):
        first, second, third = (self.points[self.triangles[:, k]] for k in range(3))
        return numpy.cross(second - first, third - first)

    def meshio(self):
        """The same as a meshio.Mesh, for every format that meshio writes."""
        import meshio
        cells = [("triangle", self.triangles)] if len(self.triangles) else [("vertex", numpy.arange(len(self.points))[:, None])]
        cellData = {name: [values] for name, values in self.cellData.items()} if len(self.triangles) else {}
        return meshio.Mesh(self.points, cells, point_data=self.pointData, cell_data=cellData)


def entries(pvd):
    """Times [s] and files of a results/STREAM.pvd."""
    pvd = pathlib.Path(pvd)
    root = xml.etree.ElementTree.parse(pvd).getroot()
    return [(float(one.get("timestep")), pvd.parent / one.get("file")) for one in root.iter("DataSet")]


def readSurface(path):
    """A .vtp or .pvtp file."""
    try:
        import vtkmodules.vtkIOXML as readers
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError as error:
        raise ImportError("meshes and particles are read by VTK: apt-get install python3-vtk9, or python3-paraview, which has VTK, too") from error
    path = pathlib.Path(path)
    if not path.is_file():
        raise FileNotFoundError(path)
    reader = (readers.vtkXMLPPolyDataReader if path.suffix == ".pvtp" else readers.vtkXMLPolyDataReader)()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()

    def arrays(of):
        found = {}
        for k in range(of.GetNumberOfArrays()):
            array = of.GetArray(k)
            if array is not None:  # texts are none
                found[array.GetName()] = vtk_to_numpy(array).copy()
        return found
    polygons = data.GetPolys()
    corners = vtk_to_numpy(polygons.GetConnectivityArray()).copy() if polygons.GetNumberOfCells() else numpy.zeros(0, dtype=numpy.int64)
    points = vtk_to_numpy(data.GetPoints().GetData()).copy() if data.GetNumberOfPoints() else numpy.zeros((0, 3))
    fieldData = arrays(data.GetFieldData())
    if path.suffix == ".pvtp" and "TimeValue" not in fieldData:  # VTK leaves field data of the pieces out
        pieces = [piece.get("Source") for piece in xml.etree.ElementTree.parse(path).getroot().iter("Piece")]
        if pieces:
            first = readers.vtkXMLPolyDataReader()
            first.SetFileName(str(path.parent / pieces[0]))
            first.Update()
            fieldData = arrays(first.GetOutput().GetFieldData())
    return Surface(points, corners.reshape(-1, 3), arrays(data.GetPointData()), arrays(data.GetCellData()), fieldData)
