// Nade.cs as a program sees it: layouts, mistakes, strokes, and that a frame does not allocate.
//   NadeTest.exe HEADER SYMBOLS     nade.h, and the list of what the library exports
// Runs with MONO_GC_PARAMS=nursery-size=1m, so that what is allocated shows soon.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using Nade;

internal static class NadeTest
{
    private const long FrameNs = 11111111;
    private static int failures;

    private static int Main(string[] arguments)
    {
        CheckLayouts();
        CheckConstants(File.ReadAllText(arguments[0]));
        CheckFunctions(File.ReadAllLines(arguments[1]));
        CheckShapes();
        CheckMistakes();
        CheckFrameMistakes();
        CheckStrokes();
        CheckSkin();
        CheckReports();
        CheckAllocation();
        Console.WriteLine(failures == 0 ? "all well" : failures + " failed");
        return failures == 0 ? 0 : 1;
    }

    private static void Check(bool condition, string what)
    {
        if (condition) return;
        Console.WriteLine("failed: " + what);
        ++failures;
    }

    private static void Equal<T>(T found, T wanted, string what)
    {
        Check(Equals(found, wanted), what + ": expected " + wanted + ", found " + found);
    }

    private static void Throws(Action action, ErrorCode code, string part)
    {
        try
        {
            action();
            Check(false, part + ": expected an exception");
        }
        catch (NadeException thrown)
        {
            Equal(thrown.Code, code, part);
            Check(thrown.Message.Contains(part), part + ": found '" + thrown.Message + "'");
        }
    }

    // --- The header ----------------------------------------------------------------------------

    private static void Layout(Type type, int size, params object[] fields)
    {
        Equal(Marshal.SizeOf(type), size, type.Name);
        for (int i = 0; i < fields.Length; i += 2)
        {
            var name = (string)fields[i];
            Equal((int)Marshal.OffsetOf(type, name), (int)fields[i + 1], type.Name + "." + name);
        }
        Equal(type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic).Length,
              fields.Length / 2, type.Name + ", fields");
    }

    // As tests/c/c_test.c has them.
    private static void CheckLayouts()
    {
        Layout(typeof(HandJoint), 32, "Rotation", 0, "Position", 16, "Radius", 28);
        Layout(typeof(Placement), 32, "Rotation", 0, "Position", 16, "Scale", 28);
        Layout(typeof(Feel), 48, "Size", 0, "Reserved", 4, "SoftnessM", 8, "SoftnessDepthM", 16,
               "Friction", 24, "FrictionKinetic", 32, "LongestLagM", 40);
        Layout(typeof(Contact), 56, "Object", 0, "Bone", 8, "DepthM", 12, "Point", 16, "Normal", 28,
               "VelocityMps", 40, "Reserved", 52);
        Equal(sizeof(int) * CorrectedHand.Words, 2056, "CorrectedHand");
        Layout(typeof(MeshReport), 32, "Size", 0, "Solid", 4, "TrianglesUsed", 8, "TrianglesDegenerate", 12,
               "TrianglesDuplicate", 16, "TrianglesTurned", 20, "BorderEdges", 24, "NonmanifoldEdges", 28);
        Layout(typeof(SurfacePoint), 56, "Point", 0, "Normal", 24, "SignedDistance", 48);
        Layout(typeof(RayHit), 56, "Point", 0, "Normal", 24, "Distance", 48);
        Layout(typeof(Native.CorrectorOptions), 48, "Size", 0, "Method", 4, "ReleaseS", 8,
               "HandLengthM", 16, "Feel", 24, "LeftFlesh", 32, "RightFlesh", 40);
        Layout(typeof(Native.Mesh), 40, "Size", 0, "VertexCount", 4, "TriangleCount", 8, "Scale", 12,
               "Vertices", 24, "Triangles", 32);
        Layout(typeof(Native.SurfaceCallbacks), 56, "Size", 0, "Reserved", 4, "User", 8, "ClosestPoint", 16,
               "FirstHit", 24, "Shape", 32, "Bounds", 40, "Release", 48);
        Layout(typeof(Native.GroupMember), 40, "Surface", 0, "Placement", 8);
        Layout(typeof(Native.HandMesh), 64, "Size", 0, "Side", 4, "VertexCount", 8, "TriangleCount", 12,
               "Vertices", 16, "Normals", 24, "Triangles", 32, "Bones", 40, "Weights", 48, "Bind", 56);
    }

    private static readonly Dictionary<string, Type> enums = new Dictionary<string, Type>
    {
        { "ERROR", typeof(ErrorCode) }, { "CAN", typeof(Capability) }, { "METHOD", typeof(Method) },
        { "HAND", typeof(HandStatus) }, { "FAULT", typeof(Fault) }, { "SOLID", typeof(Solid) },
        { "JOINT", typeof(JointIndex) }
    };

    private static void CheckConstants(string header)
    {
        Equal(Library.AbiVersion, uint.Parse(Regex.Match(header, @"NADE_ABI_VERSION (\d+)").Groups[1].Value),
              "AbiVersion");
        int seen = 0;
        foreach (Match match in Regex.Matches(header, @"^\s+NADE_([A-Z]+)_([A-Z_]+) = (-?\d+)",
                                              RegexOptions.Multiline))
        {
            string kind = match.Groups[1].Value, name = match.Groups[2].Value;
            int value = int.Parse(match.Groups[3].Value);
            if (kind == "MAX" || name == "COUNT") continue;
            Check(enums.ContainsKey(kind), match.Value + ": an enum for it");
            name = string.Concat(name.Split('_').Select(word => word[0] + word.Substring(1).ToLower()));
            Equal(Enum.GetName(enums[kind], value), name, match.Value.Trim());
            ++seen;
        }
        Equal(seen + 1, enums.Values.Sum(type => Enum.GetNames(type).Length), "names");  // NADE_OK
        Equal((int)Side.Left, 0, "Side.Left");
        Equal((int)Side.Right, 1, "Side.Right");
        Equal(int.Parse(Regex.Match(header, @"MAX_CONTACTS = (\d+)").Groups[1].Value), Library.MaxContacts,
              "MaxContacts");
    }

    private static void CheckFunctions(string[] symbols)
    {
        var bound = typeof(Native).GetMethods(BindingFlags.Static | BindingFlags.NonPublic)
            .Where(method => method.GetCustomAttribute<DllImportAttribute>() != null)
            .Select(method => method.Name).OrderBy(name => name, StringComparer.Ordinal);
        Check(bound.SequenceEqual(symbols.OrderBy(name => name, StringComparer.Ordinal)),
              "the functions are those of the library");
        Check(Library.Version.Contains("."), "Version");
        Check(Library.Has(Capability.Correct) && !Library.Has(Capability.Record), "Has");
        Check(Library.TextOf(Fault.NotFinite).Contains("finite"), "TextOf");
        Check(Library.TextOf(ErrorCode.Data).Length > 0, "TextOf");
    }

    // --- Surfaces ------------------------------------------------------------------------------

    private static void CheckTop(string name, Surface surface, double top)
    {
        using (surface)
        {
            SurfacePoint point;
            bool found;
            var query = new Double3(0, 2 * top + 0.02, 0);
            var twice = new Placement(new Float3(0, 0, 0), new Float4(0, 0, 0, 1), 2);
            Equal(surface.ClosestPoint(query, 1, twice, out point, out found), ErrorCode.Ok, name);
            Check(found && Math.Abs(point.SignedDistance - 0.02) < 1e-6 && point.Normal.Y > 0.99, name);
            surface.ClosestPoint(new Double3(0, 9, 0), 1, twice, out point, out found);
            Check(!found, name + ", far away");
        }
    }

    // Two pyramids of four sides, up and down.
    private static readonly float[] octahedron =
        { 0, 0.1f, 0, 0.1f, 0, 0, 0, 0, 0.1f, -0.1f, 0, 0, 0, 0, -0.1f, 0, -0.1f, 0 };
    private static readonly int[] faces =
        { 0, 2, 1, 0, 3, 2, 0, 4, 3, 0, 1, 4, 5, 1, 2, 5, 2, 3, 5, 3, 4, 5, 4, 1 };

    private static void CheckShapes()
    {
        float[] outline = { -1, -1, -1, 1, 1, 1, 1, -1 };
        CheckTop("plane", Surface.Plane(), 0);
        CheckTop("plate", Surface.Plate(outline, 0.1), 0);
        CheckTop("sphere", Surface.Sphere(0.15), 0.15);
        CheckTop("ellipsoid", Surface.Ellipsoid(new Double3(0.1, 0.2, 0.3)), 0.2);
        CheckTop("box", Surface.Box(new Double3(0.1, 0.2, 0.3), 0.01), 0.2);
        CheckTop("cylinder", Surface.Cylinder(0.3, 0.1, 0.02), 0.3);
        CheckTop("capsule", Surface.Capsule(0.2, 0.05), 0.15);
        CheckTop("height field", Surface.HeightField(new[] { 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f }, 2, 3, 0.5),
                 0.2);
        CheckTop("custom", Surface.Custom(new Floor()), 0);
        CheckTop("group", Surface.Group(new[] { Surface.Sphere(0.1) }, new[] { Placement.At(0, 0.1f, 0) }),
                 0.2);
        MeshReport report;
        using (var mesh = Surface.Mesh(octahedron, faces, new Float3(1, 1, 1), out report))
        using (var hull = Surface.Hull(octahedron))
        {
            Equal(report.Solid, Solid.Closed, "mesh");
            Equal(report.TrianglesUsed, 8u, "mesh");
            SurfacePoint point, other;
            bool found;
            var query = new Double3(0.1, 0.1, 0.1);
            mesh.ClosestPoint(query, 1, Placement.Identity, out point, out found);
            hull.ClosestPoint(query, 1, Placement.Identity, out other, out found);
            Check(found && Math.Abs(point.SignedDistance - other.SignedDistance) < 1e-6, "mesh and hull");
            Equal(mesh.Refit(octahedron.Select(x => 2 * x).ToArray()), ErrorCode.Ok, "refit");
            mesh.ClosestPoint(query, 1, Placement.Identity, out point, out found);
            Check(point.SignedDistance > other.SignedDistance - 0.06, "refit");
            Equal(mesh.Refit(new float[3]), ErrorCode.Argument, "refit, too few");
            Equal(mesh.Refit(new float[octahedron.Length - 1]), ErrorCode.Argument, "refit, no whole vertices");
            Equal(mesh.PlaceMember(-1, Placement.Identity), ErrorCode.Handle, "no group");
        }
    }

    /// <summary>The half-space below y = 0, once more.</summary>
    private sealed class Floor : IRayShape, IChangingShape, IBoundedShape
    {
        internal int Calls;
        internal bool Fails;

        public bool ClosestPoint(Double3 query, double maxDistance, ref uint hint, out SurfacePoint point)
        {
            ++Calls;
            if (Fails) throw new InvalidOperationException();
            hint = 7;
            point = new SurfacePoint
            {
                Point = new Double3(query.X, 0, query.Z), Normal = new Double3(0, 1, 0),
                SignedDistance = query.Y
            };
            return Math.Abs(query.Y) <= maxDistance;
        }

        public bool FirstHit(Double3 origin, Double3 direction, double maxDistance, out RayHit hit)
        {
            ++Calls;
            double way = -origin.Y / direction.Y;
            hit = new RayHit
            {
                Point = new Double3(origin.X + way * direction.X, 0, origin.Z + way * direction.Z),
                Normal = new Double3(0, 1, 0), Distance = way
            };
            return way >= 0 && way <= maxDistance;
        }

        public ulong Shape { get { return 1; } }

        public bool Bounds(out Double3 low, out Double3 high)
        {
            low = new Double3(-9, -9, -9);
            high = new Double3(9, 0, 9);
            return true;
        }
    }

    // --- Mistakes ------------------------------------------------------------------------------

    private static void CheckMistakes()
    {
        Throws(() => Surface.Sphere(-1), ErrorCode.Argument,
               "nade_surface_create_sphere: radius_m: expected a number above 0, found -1");
        Throws(() => Surface.Box(new Double3(0.1, double.NaN, 0.1)), ErrorCode.Argument, "half_size_m");
        Throws(() => Surface.Plate(null, 0.1), ErrorCode.Argument, "outline_xz");
        Throws(() => Surface.HeightField(new float[5], 2, 2, 0.1), ErrorCode.Argument, "heights");
        Throws(() => Surface.Hull(new float[12]), ErrorCode.Data, "nade_surface_create_hull");
        Throws(() => Surface.Mesh(octahedron, new[] { 0, 1, 9 }), ErrorCode.Data, "triangle");
        Throws(() => Surface.Mesh(octahedron, new[] { 0, 1, -1 }), ErrorCode.Data, "triangle");
        Throws(() => Surface.Mesh(octahedron, new[] { 0, 1 }), ErrorCode.Argument,
               "Surface: triangles: expected 3 numbers of each, found 2 in all");
        Throws(() => Surface.Group(new[] { Surface.Plane() }, null), ErrorCode.Argument, "placements");
        Throws(() => new Corrector(new CorrectorOptions { ReleaseS = double.NaN }), ErrorCode.Argument,
               "release_s");
        Throws(() => new CorrectorOptions { Method = (Method)3 }.Check(), ErrorCode.Argument, "method");
        Throws(() => new CorrectorOptions { Feel = new Feel() }.Check(), ErrorCode.Argument, "softness_depth_m");
        Throws(() => Library.RestHand((Side)2), ErrorCode.Argument, "side");
        Throws(() => new Flesh(Side.Right, new float[9], new float[9], new int[3], new byte[12],
                               new float[11], Library.RestHand(Side.Right)), ErrorCode.Argument,
               "Flesh: weights: expected 12, found 11");
        Throws(() => new Flesh(Side.Right, new float[9], new float[9], new[] { 0, 1, 2 }, new byte[12],
                               new float[12], Library.RestHand(Side.Right)), ErrorCode.Data, "weights");
        using (var scene = new Scene())
        using (var plane = Surface.Plane())
        {
            scene.Add(1, plane, Placement.Identity);
            Throws(() => scene.Add(1, plane, Placement.Identity), ErrorCode.Id, "nade_scene_add");
            Throws(() => scene.Add(2, plane, new Placement()), ErrorCode.Argument, "rotation");
            Throws(() => scene.Remove(2), ErrorCode.Id, "nade_scene_remove");
            Equal(scene.Count, 1, "Count");
            plane.Dispose();
            try
            {
                scene.Add(3, plane, Placement.Identity);
                Check(false, "a surface that was disposed of");
            }
            catch (ObjectDisposedException) { }
        }
    }

    private static void CheckFrameMistakes()
    {
        var joints = Library.RestHand(Side.Left);
        var hand = new CorrectedHand();
        var feel = Feel.Default;
        feel.Friction = double.NaN;
        var gone = Surface.Plane();
        gone.Dispose();
        var scene = new Scene();
        var corrector = new Corrector();
        Equal(corrector.Update(Side.Left, joints, (Surface)null, 0, hand), ErrorCode.Ok, "no surface");
        Equal(hand.Status, HandStatus.Free, "no surface");
        Equal(corrector.Update(Side.Left, joints, gone, 1, hand), ErrorCode.Handle, "gone");
        Equal(corrector.Update(Side.Left, joints, (Scene)null, 1, hand), ErrorCode.Handle, "no scene");
        Equal(corrector.Update((Side)5, joints, scene, 1, hand), ErrorCode.Argument, "side");
        Check(Library.LastError.Contains("side"), "side: found '" + Library.LastError + "'");
        Equal(corrector.Update(Side.Left, new HandJoint[25], scene, 1, hand), ErrorCode.Argument, "25 joints");
        Equal(corrector.Update(Side.Left, null, scene, 1, hand), ErrorCode.Argument, "no joints");
        Equal(corrector.Update(Side.Left, joints, scene, 1, null), ErrorCode.Argument, "no result");
        Equal(corrector.Preview(Side.Left, joints, null), ErrorCode.Argument, "preview");
        Equal(corrector.SetFeel(feel), ErrorCode.Argument, "feel");
        Equal(scene.Place(4, Placement.Identity), ErrorCode.Id, "id");
        Equal(scene.Deformed(4), ErrorCode.Id, "id");
        Equal(scene.SetFeel(4, Feel.Default), ErrorCode.Id, "id");
        joints[10].Position.Y = float.NaN;
        Equal(corrector.Update(Side.Left, joints, scene, 2, hand), ErrorCode.Ok, "a hand that is none");
        Equal(hand.Status, HandStatus.Untracked, "a hand that is none");
        Equal(hand.Fault, Fault.NotFinite, "a hand that is none");
        scene.Dispose();
        Equal(scene.Place(4, Placement.Identity), ErrorCode.Handle, "scene gone");
        corrector.Dispose();
        Equal(corrector.Reset(), ErrorCode.Handle, "corrector gone");
        Equal(corrector.Update(Side.Left, joints, Surface.Plane(), 1, hand), ErrorCode.Handle, "gone");
        corrector.Dispose();
    }

    // --- Strokes -------------------------------------------------------------------------------

    /// <summary>Presses a hand 20 mm onto what is below y = 0.</summary>
    private static CorrectedHand Stroke(Corrector corrector, Surface surface, Scene scene)
    {
        var rest = Library.RestHand(Side.Right);
        var tracked = new HandJoint[Library.JointCount];
        var hand = new CorrectedHand();
        for (int frame = 0; frame <= 60; ++frame)
        {
            for (int i = 0; i < tracked.Length; ++i)
            {
                tracked[i] = rest[i];
                tracked[i].Position.Y += 0.08f - 0.1f * frame / 60;
                tracked[i].Radius = 0.01f;
            }
            var code = scene == null
                ? corrector.Update(Side.Right, tracked, surface, Placement.Identity, 5, frame * FrameNs, hand)
                : corrector.Update(Side.Right, tracked, scene, frame * FrameNs, hand);
            Equal(code, ErrorCode.Ok, "Update");
        }
        Equal(hand.Status, HandStatus.Corrected, "stroke");
        Check(hand.Joints[0].Position.Y > tracked[0].Position.Y + 0.01f, "the palm is lifted");
        Equal(hand.Joints[3].Radius, 0.01f, "radius");
        Check(hand.ContactCount > 0 && hand.ContactCount <= Library.MaxContacts, "contacts");
        for (int i = 0; i < hand.ContactCount; ++i)
        {
            var contact = hand.Contacts[i];
            Equal(contact.Object, 5ul, "contact");
            Check(contact.Normal.Y > 0.999f && Math.Abs(contact.Point.Y) < 1e-5 && contact.DepthM > 0,
                  "contact");
        }
        var drawn = new HandJoint[Library.JointCount];
        Equal(corrector.Preview(Side.Right, tracked, drawn), ErrorCode.Ok, "Preview");
        Check(Math.Abs(drawn[0].Position.Y - hand.Joints[0].Position.Y) < 1e-6, "Preview");
        return hand;
    }

    private static void CheckStrokes()
    {
        var floor = new Floor();
        var soft = Feel.Default;
        soft.SoftnessM = 0.02;
        CorrectedHand plane, custom, sunk, inScene;
        using (var corrector = new Corrector()) plane = Stroke(corrector, Surface.Plane(), null);
        using (var corrector = new Corrector()) custom = Stroke(corrector, Surface.Custom(floor), null);
        using (var corrector = new Corrector(new CorrectorOptions { Feel = soft }))
        {
            sunk = Stroke(corrector, Surface.Plane(), null);
        }
        using (var scene = new Scene())
        using (var corrector = new Corrector())
        {
            using (var surface = Surface.Plane()) scene.Add(5, surface, Placement.Identity);
            inScene = Stroke(corrector, null, scene);
        }
        Check(floor.Calls > 100, "the shape is asked");
        for (int i = 0; i < Library.JointCount; ++i)
        {
            Check(Apart(plane.Joints[i], custom.Joints[i]) < 1e-6, "custom surface");
            Check(Apart(plane.Joints[i], inScene.Joints[i]) < 1e-6, "scene");
        }
        Check(sunk.Joints[0].Position.Y < plane.Joints[0].Position.Y - 0.002f, "softness");

        floor.Fails = true;
        using (var corrector = new Corrector())
        {
            var hand = new CorrectedHand();
            var code = corrector.Update(Side.Left, Library.RestHand(Side.Left), Surface.Custom(floor), 0, hand);
            Equal(code, ErrorCode.Ok, "a shape that throws");
        }
    }

    /// <summary>Three corners below the wrist and below the middle finger's tip.</summary>
    private static Skin SmallSkin(HandJoint[] bind)
    {
        var vertices = new float[18];
        var normals = new float[18];
        var bones = new byte[24];
        var weights = new float[24];
        for (int i = 0; i < 6; ++i)
        {
            var bone = i < 3 ? JointIndex.Wrist : JointIndex.MiddleTip;
            var at = bind[(int)bone].Position;
            vertices[3 * i] = at.X + (i % 3 == 1 ? 0.004f : 0);
            vertices[3 * i + 1] = at.Y - 0.008f;
            vertices[3 * i + 2] = at.Z - (i % 3 == 2 ? 0.004f : 0);
            normals[3 * i + 1] = -1;
            bones[4 * i] = (byte)bone;
            weights[4 * i] = 1;
        }
        return new Skin(Side.Right, vertices, normals, new[] { 0, 1, 2, 3, 4, 5 }, bones, weights, bind);
    }

    private static void CheckSkin()
    {
        var joints = Library.RestHand(Side.Right);
        using (var plane = Surface.Plane())
        using (var scene = new Scene())
        using (var skin = SmallSkin(joints))
        {
            scene.Add(1, plane, Placement.Identity);
            float down = 0.006f - joints[(int)JointIndex.MiddleTip].Position.Y;
            for (int i = 0; i < joints.Length; ++i) joints[i].Position.Y += down;
            var posed = new float[18];
            var normals = new float[18];
            Equal(skin.Pose(joints, 1, posed, normals), ErrorCode.Ok, "Pose");
            Check(Math.Abs(posed[10] + 0.002) < 1e-6, "Pose");
            var flat = (float[])posed.Clone();
            Equal(skin.Flatten(joints, 1, plane, Placement.Identity, 0, flat, normals), ErrorCode.Ok, "Flatten");
            Check(flat[10] > 0.0001f, "Flatten");
            flat = (float[])posed.Clone();
            Equal(skin.Flatten(joints, 1, scene, 0, flat, null), ErrorCode.Ok, "Flatten, scene");
            Check(flat[10] > 0.0001f, "Flatten, scene");
            Equal(skin.Flatten(joints, 1, null, Placement.Identity, 0, posed, normals), ErrorCode.Ok, "nothing");
            Check(Math.Abs(posed[10] + 0.002) < 1e-6, "nothing");
            Equal(skin.Pose(joints, 1, posed, new float[15]), ErrorCode.Argument, "normals");
            Equal(skin.Pose(joints, 1, new float[15], null), ErrorCode.Argument, "vertices");
            Equal(skin.Flatten(joints, double.NaN, scene, 0, flat, null), ErrorCode.Argument, "scale");
            Equal(skin.Flatten(joints, 1, (Scene)null, 0, flat, null), ErrorCode.Handle, "no scene");
            joints[1].Position.X = float.NaN;
            Equal(skin.Pose(joints, 1, posed, null), ErrorCode.Data, "a hand that is none");
            skin.Dispose();
            Equal(skin.Pose(joints, 1, posed, null), ErrorCode.Handle, "skin gone");
        }
    }

    private static double Apart(HandJoint a, HandJoint b)
    {
        double x = a.Position.X - b.Position.X, y = a.Position.Y - b.Position.Y;
        double z = a.Position.Z - b.Position.Z;
        return Math.Sqrt(x * x + y * y + z * z);
    }

    private static void CheckReports()
    {
        var told = new List<string>();
        Library.ReportFailuresTo((code, sentence) => told.Add(code + ": " + sentence));
        Throws(() => Surface.Sphere(0), ErrorCode.Argument, "radius_m");
        Library.ReportFailuresTo(null);
        Throws(() => Surface.Sphere(0), ErrorCode.Argument, "radius_m");
        Equal(told.Count, 1, "reports");
        Check(told[0].StartsWith("Argument: nade_surface_create_sphere"), told[0]);
    }

    // --- Memory --------------------------------------------------------------------------------

    /// <summary>How often the smallest generation is collected meanwhile.</summary>
    private static int Collections(int times, Action<int> frame)
    {
        frame(0);
        GC.Collect();
        int before = GC.CollectionCount(0);
        for (int i = 1; i <= times; ++i) frame(i);
        return GC.CollectionCount(0) - before;
    }

    private static void CheckAllocation()
    {
        const int Times = 200000;
        var joints = Library.RestHand(Side.Right);
        var drawn = new HandJoint[Library.JointCount];
        var hand = new CorrectedHand();
        var corrector = new Corrector(new CorrectorOptions { Method = Method.None });
        var surface = Surface.Plane();
        var mesh = Surface.Mesh(octahedron, faces);
        var scene = new Scene();
        scene.Add(1, surface, Placement.At(0, -9, 0));
        var skin = SmallSkin(joints);
        var vertices = new float[18];
        object kept = null;
        Check(Collections(Times, i => kept = new object()) > 0, "what is allocated shows");
        Check(kept != null, "kept");
        Equal(Collections(Times, i =>
        {
            corrector.Update(Side.Right, joints, surface, i * FrameNs, hand);
            corrector.Preview(Side.Right, joints, drawn);
            skin.Pose(joints, 1, vertices, null);
            skin.Flatten(joints, 1, surface, Placement.Identity, 0, vertices, null);
        }), 0, "a frame allocates");
        Equal(Collections(Times / 2, i =>
        {
            scene.Place(1, Placement.At(0, -9, 0));
            scene.Deformed(1);
            scene.SetFeel(1, new Feel { SoftnessDepthM = 0.02 });
            mesh.Refit(octahedron);
            corrector.Update(Side.Right, joints, scene, i * FrameNs, hand);
        }), 0, "a frame with a scene allocates");
    }
}
