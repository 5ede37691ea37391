// Corrects the hands of a file by Nade.cs: CorrectStrokes.exe IN OUT, in the formats of
// web/test/reference.c.
using System;
using System.Diagnostics;
using System.IO;
using Nade;

internal static class CorrectStrokes
{
    private static int Main(string[] arguments)
    {
        using (var reader = new BinaryReader(File.OpenRead(arguments[0])))
        using (var writer = new BinaryWriter(File.Create(arguments[1])))
        {
            while (reader.BaseStream.Position < reader.BaseStream.Length) Correct(reader, writer);
        }
        return 0;
    }

    private static void Correct(BinaryReader reader, BinaryWriter writer)
    {
        var options = new CorrectorOptions { Method = (Method)reader.ReadUInt32() };
        int kind = reader.ReadInt32(), vertexCount = reader.ReadInt32(), triangleCount = reader.ReadInt32();
        var times = new double[reader.ReadInt32()];
        var vertices = new float[3 * vertexCount];
        var triangles = new int[3 * triangleCount];
        for (int i = 0; i < vertices.Length; ++i) vertices[i] = reader.ReadSingle();
        for (int i = 0; i < triangles.Length; ++i) triangles[i] = reader.ReadInt32();
        var hand = new CorrectedHand();
        var joints = new HandJoint[Library.JointCount];
        using (var surface = kind == 0 ? Surface.Plane()
                             : kind == 1 ? Surface.Sphere(0.1) : Surface.Mesh(vertices, triangles))
        using (var left = new Corrector(options))
        using (var right = new Corrector(options))
        {
            for (int i = 0; i < times.Length; ++i)
            {
                long timeNs = reader.ReadInt64();
                var side = (Side)reader.ReadInt32();
                reader.ReadInt32();
                for (int k = 0; k < joints.Length; ++k) joints[k] = ReadJoint(reader);
                long start = Stopwatch.GetTimestamp();
                var code = (side == Side.Left ? left : right).Update(side, joints, surface, timeNs, hand);
                times[i] = 1e9 * (Stopwatch.GetTimestamp() - start) / Stopwatch.Frequency;
                if (code != ErrorCode.Ok) throw new NadeException(code, Library.LastError);
                foreach (var joint in hand.Joints) Write(writer, joint);
            }
        }
        Array.Sort(times);
        writer.Write(times[times.Length / 2]);
    }

    private static HandJoint ReadJoint(BinaryReader reader)
    {
        var rotation = new Float4(reader.ReadSingle(), reader.ReadSingle(), reader.ReadSingle(),
                                  reader.ReadSingle());
        var position = new Float3(reader.ReadSingle(), reader.ReadSingle(), reader.ReadSingle());
        return new HandJoint { Rotation = rotation, Position = position, Radius = reader.ReadSingle() };
    }

    private static void Write(BinaryWriter writer, HandJoint joint)
    {
        var q = joint.Rotation;
        var p = joint.Position;
        foreach (float number in new[] { q.X, q.Y, q.Z, q.W, p.X, p.Y, p.Z, joint.Radius }) writer.Write(number);
    }
}
