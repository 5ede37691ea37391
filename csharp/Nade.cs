// nade in C#: keeps a tracked hand on the surface it strokes. This one file over the library nade.h
// describes (libnade.so, nade.dll); C# 7.0, .NET 4.x or .NET Standard 2.0, needs nothing else.
//
//   var corrector = new Nade.Corrector();                      // one for each hand
//   var table = Nade.Surface.Plane();
//   var hand = new Nade.CorrectedHand();                       // filled anew by each frame
//   for each frame: corrector.Update(Nade.Side.Right, joints, table, timeNs, hand);
//                   draw hand.Joints
//
// Metres, seconds, radians; right-handed, +Y up. Quaternions are x y z w. A hand has 26 joints in the
// order of XrHandJointEXT, in OpenXR's frames: -Z to the fingertip, +Y to the back of the hand.
//
// What returns an ErrorCode belongs into a frame: it neither throws nor allocates, and a call that
// failed has changed nothing; Library.LastError has the sentence. All else throws a NadeException.
//
// A surface may be disposed of while a scene has it. One thread at a time uses an object, but any
// number of correctors may run at once on surfaces and scenes that nobody changes meanwhile.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Nade
{
    public enum ErrorCode
    {
        Ok = 0,
        Argument = -1, // null, not finite, or out of range
        Handle = -2,   // null, disposed of, or of another kind
        Size = -3,
        Id = -4,       // an object's id is taken, or there is none of that id
        Data = -5,     // a mesh, hull, height field or hand mesh that cannot be used
        Memory = -6,
        Internal = -7  // a bug in nade
    }

    public enum Capability { Correct = 0, Record = 1 }

    public enum Side { Left = 0, Right = 1 }

    public enum Method
    {
        None = 0,  // the tracked hand, bit for bit
        Paper = 1, // palm and fingertips are moved out (2023), the baseline
        Nade = 2   // a proxy hand with soft flesh lies on the surface; the default
    }

    /// <summary>What became of a tracked hand.</summary>
    public enum HandStatus
    {
        Free = 0,      // nothing touched: the tracked hand, bit for bit
        Corrected = 1, // some part rests on an object, or is braked to land on it
        Released = 2,  // nothing touched any more, what was left of a correction fades
        Untracked = 3  // the hand could not be used, see Fault: as it was passed
    }

    /// <summary>Why a hand could not be used; Library.TextOf says it in words.</summary>
    public enum Fault
    {
        None = 0, NotFinite = 1, RotationNotUnit = 2, WristFar = 3, JointFar = 4, NoLength = 5
    }

    /// <summary>How a mesh tells inside from outside.</summary>
    public enum Solid
    {
        Closed = 0,    // clean and closed
        Defective = 1, // with holes or doubled parts: solid as a film across them has it
        Sheet = 2      // open, and faces mostly one way: solid behind it
    }

    /// <summary>Where a joint is in the arrays of 26.</summary>
    public enum JointIndex
    {
        Palm = 0, Wrist = 1,
        ThumbMetacarpal = 2, ThumbProximal = 3, ThumbDistal = 4, ThumbTip = 5,
        IndexMetacarpal = 6, IndexProximal = 7, IndexIntermediate = 8, IndexDistal = 9, IndexTip = 10,
        MiddleMetacarpal = 11, MiddleProximal = 12, MiddleIntermediate = 13, MiddleDistal = 14,
        MiddleTip = 15,
        RingMetacarpal = 16, RingProximal = 17, RingIntermediate = 18, RingDistal = 19, RingTip = 20,
        LittleMetacarpal = 21, LittleProximal = 22, LittleIntermediate = 23, LittleDistal = 24,
        LittleTip = 25
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Float3
    {
        public float X, Y, Z;
        public Float3(float x, float y, float z) { X = x; Y = y; Z = z; }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Float4
    {
        public float X, Y, Z, W;
        public Float4(float x, float y, float z, float w) { X = x; Y = y; Z = z; W = w; }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Double3
    {
        public double X, Y, Z;
        public Double3(double x, double y, double z) { X = x; Y = y; Z = z; }
    }

    /// <summary>A joint, 32 bytes, as XrHandJointLocationEXT holds it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct HandJoint
    {
        public Float4 Rotation;
        public Float3 Position;
        public float Radius; // joint to skin, 0 where it is not known; passed through
    }

    /// <summary>Where an object stands: scaled, turned, moved.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Placement
    {
        public Float4 Rotation;
        public Float3 Position;
        public float Scale; // along all axes, above 0; 0 hides the object

        public Placement(Float3 position, Float4 rotation, float scale = 1)
        {
            Rotation = rotation;
            Position = position;
            Scale = scale;
        }

        public static Placement At(float x, float y, float z)
        {
            return new Placement(new Float3(x, y, z), new Float4(0, 0, 0, 1));
        }

        public static Placement Identity { get { return At(0, 0, 0); } }
    }

    /// <summary>What an object is like under the hand; change what Default gives.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Feel
    {
        internal uint Size;
        internal uint Reserved;
        public double SoftnessM;       // the skin sinks in so far at the most, 0 to 0.02
        public double SoftnessDepthM;  // pressing so deep sinks by two thirds of that
        public double Friction;        // lag over pressing depth at which the hand slips, 0 to 2
        public double FrictionKinetic; // share of the lag that is left while it slips, 0 to 1
        public double LongestLagM;     // whatever the depth

        /// <summary>Hard, without friction.</summary>
        public static Feel Default
        {
            get
            {
                var feel = new Feel { Size = Bytes };
                Library.Must(Native.nade_feel_init(ref feel));
                return feel;
            }
        }

        internal static uint Bytes { get { return (uint)Marshal.SizeOf(typeof(Feel)); } }
    }

    /// <summary>Skin of one bone that touches.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Contact
    {
        public ulong Object;     // id in the scene; outside of one the number passed to Update
        public JointIndex Bone;  // the joint at a phalanx's base, ThumbMetacarpal, or Palm for the rest
        public float DepthM;     // of the person's skin in the object: how it presses
        public Float3 Point;     // on the surface
        public Float3 Normal;    // unit, out of the solid
        public Float3 VelocityMps; // of the drawn skin there against the object
        internal uint Reserved;
    }

    /// <summary>What was found, and mended, in a mesh.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct MeshReport
    {
        internal uint Size;
        public Solid Solid;
        public uint TrianglesUsed;
        public uint TrianglesDegenerate; // without area; left out
        public uint TrianglesDuplicate;  // the same three corners again; left out
        public uint TrianglesTurned;     // wound against their neighbours; turned
        public uint BorderEdges;         // edges with one triangle
        public uint NonmanifoldEdges;    // edges with more than two
    }

    /// <summary>The point of a surface nearest to a query.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SurfacePoint
    {
        public Double3 Point;
        public Double3 Normal; // out of the solid
        public double SignedDistance; // of the query: negative inside the solid
    }

    /// <summary>Where a ray meets a surface.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RayHit
    {
        public Double3 Point;
        public Double3 Normal; // out of the solid, whichever side the ray came from
        public double Distance;
    }

    /// <summary>A call that failed; the message is the library's, and names the argument.</summary>
    public sealed class NadeException : Exception
    {
        public readonly ErrorCode Code;
        public NadeException(ErrorCode code, string sentence) : base(sentence) { Code = code; }
    }

    public static class Library
    {
        public const uint AbiVersion = 1;
        public const int JointCount = 26;
        public const int MaxContacts = 16;
        public const int MaxGroupMembers = 255;

        /// <summary>The release, "0.1.0".</summary>
        public static string Version { get { return TextAt(Native.nade_version()); } }

        public static bool Has(Capability capability) { return Native.nade_has(capability) != 0; }

        public static string TextOf(ErrorCode code) { return TextAt(Native.nade_status_text(code)); }

        public static string TextOf(Fault fault) { return TextAt(Native.nade_fault_text(fault)); }

        /// <summary>The sentence of the last call of the library that failed on this thread; "" where
        /// none did.</summary>
        public static string LastError { get { return TextAt(Native.nade_last_error()); } }

        /// <summary>The receiver gets the sentence of each call that fails, on its thread; null: none.
        /// Not while another thread calls nade. It must not throw.</summary>
        public static void ReportFailuresTo(Action<ErrorCode, string> receiver)
        {
            failureReceiver = receiver;
            Native.nade_set_message_callback(receiver == null ? null : passFailureOn, IntPtr.Zero);
        }

        /// <summary>The built-in hand at rest: the palm in the origin, palm down, fingers along -Z.
        /// For tests and first steps.</summary>
        public static HandJoint[] RestHand(Side side)
        {
            var joints = new HandJoint[JointCount];
            Must(Native.nade_rest_hand(side, joints));
            return joints;
        }

        internal static void Must(ErrorCode code)
        {
            if (code != ErrorCode.Ok) throw new NadeException(code, LastError);
        }

        /// <summary>Before the first object is made.</summary>
        internal static void CheckAbi()
        {
            uint found = Native.nade_abi_version();
            if (found == AbiVersion) return;
            throw new NadeException(ErrorCode.Internal, "Nade.cs: expected a library with ABI version "
                + AbiVersion + ", found " + found);
        }

        internal static HandJoint[] WholeHand(HandJoint[] joints)
        {
            return joints != null && joints.Length >= JointCount ? joints : null;
        }

        private static Action<ErrorCode, string> failureReceiver;
        private static readonly Native.MessageCallback passFailureOn = PassFailureOn;

        [MonoPInvokeCallback(typeof(Native.MessageCallback))]
        private static void PassFailureOn(IntPtr user, ErrorCode code, IntPtr sentence)
        {
            var receiver = failureReceiver;
            if (receiver != null) receiver(code, TextAt(sentence));
        }

        private static string TextAt(IntPtr utf8)
        {
            int length = 0;
            while (Marshal.ReadByte(utf8, length) != 0) ++length;
            var bytes = new byte[length];
            Marshal.Copy(utf8, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }
    }

    /// <summary>What has to be disposed of; what is forgotten, the garbage collector frees.</summary>
    public abstract class NadeHandle : SafeHandle
    {
        internal NadeHandle() : base(IntPtr.Zero, true) { Library.CheckAbi(); }

        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

        internal void Own(ErrorCode code, IntPtr made)
        {
            Library.Must(code);
            SetHandle(made);
        }

        internal static bool CanBeUsed(NadeHandle handle) { return handle != null && !handle.IsClosed; }
    }

    /// <summary>A shape of the program's own, in its own frame. It is asked hundreds of times a
    /// frame, by each thread that corrects. An answer that throws or is not finite counts as none.
    /// </summary>
    public interface IShape
    {
        /// <summary>The nearest point no farther than maxDistance, which may be infinite. The hint is
        /// uint.MaxValue or what an earlier query nearby left there, below 2^24 - 1.</summary>
        bool ClosestPoint(Double3 query, double maxDistance, ref uint hint, out SurfacePoint point);
    }

    /// <summary>A shape that finds the first hit of a ray itself, from either side.</summary>
    public interface IRayShape : IShape
    {
        bool FirstHit(Double3 origin, Double3 direction, double maxDistance, out RayHit hit);
    }

    /// <summary>A shape that says whenever it has changed, by another number.</summary>
    public interface IChangingShape : IShape
    {
        ulong Shape { get; }
    }

    /// <summary>A shape that knows a box around itself; others a scene asks in every frame.</summary>
    public interface IBoundedShape : IShape
    {
        bool Bounds(out Double3 low, out Double3 high);
    }

    /// <summary>A surface in its own frame. Sizes are metres.</summary>
    public sealed class Surface : NadeHandle
    {
        internal static readonly Surface None = new Surface(ErrorCode.Ok, IntPtr.Zero);

        private Surface(ErrorCode code, IntPtr made) { Own(code, made); }

        protected override bool ReleaseHandle()
        {
            return Native.nade_surface_destroy(handle) == ErrorCode.Ok;
        }

        /// <summary>The half-space below y = 0.</summary>
        public static Surface Plane()
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_plane(out made), made);
        }

        /// <summary>A flat plate: x and z of each corner of its top, which is at y = 0.</summary>
        public static Surface Plate(float[] outlineXZ, double thickness)
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_plate(outlineXZ, Count(outlineXZ, 2, "outlineXZ"), thickness,
                                                                out made), made);
        }

        public static Surface Sphere(double radius)
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_sphere(radius, out made), made);
        }

        public static Surface Ellipsoid(Double3 halfAxes)
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_ellipsoid(ref halfAxes, out made), made);
        }

        /// <summary>A box about the origin; the half size is with the rounding of the edges.</summary>
        public static Surface Box(Double3 halfSize, double rounding = 0)
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_box(ref halfSize, rounding, out made), made);
        }

        /// <summary>A cylinder about the Y axis.</summary>
        public static Surface Cylinder(double halfHeight, double radius, double rounding = 0)
        {
            IntPtr made;
            return new Surface(
                Native.nade_surface_create_cylinder(halfHeight, radius, rounding, out made), made);
        }

        /// <summary>What is within a radius of a line along Y.</summary>
        public static Surface Capsule(double length, double radius)
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_capsule(length, radius, out made), made);
        }

        /// <summary>The smallest convex solid with all points (x y z of each) in it.</summary>
        public static Surface Hull(float[] points)
        {
            IntPtr made;
            return new Surface(Native.nade_surface_create_hull(points, Count(points, 3, "points"), out made), made);
        }

        /// <summary>Heights (Y), rows (+Z) of columns (+X), a step apart, about the origin.</summary>
        public static Surface HeightField(float[] heights, int columns, int rows, double step)
        {
            if (heights != null && (columns < 0 || rows < 0 || (long)columns * rows != heights.Length))
            {
                throw new NadeException(ErrorCode.Argument, "Surface.HeightField: heights: expected "
                    + columns + " times " + rows + " numbers, found " + heights.Length);
            }
            IntPtr made;
            return new Surface(Native.nade_surface_create_height_field(
                heights, (UIntPtr)(uint)columns, (UIntPtr)(uint)rows, step, out made), made);
        }

        public static Surface Mesh(float[] vertices, int[] triangles)
        {
            MeshReport report;
            return Mesh(vertices, triangles, new Float3(1, 1, 1), out report);
        }

        /// <summary>x y z of each vertex, three indices of each triangle, counter-clockwise seen from
        /// outside; about a second for a million triangles.</summary>
        public static Surface Mesh(float[] vertices, int[] triangles, Float3 scale, out MeshReport report)
        {
            using (var pins = new Pins())
            {
                var mesh = new Native.Mesh
                {
                    Size = (uint)Marshal.SizeOf(typeof(Native.Mesh)),
                    VertexCount = (uint)Count(vertices, 3, "vertices"),
                    TriangleCount = (uint)Count(triangles, 3, "triangles"),
                    Scale = scale,
                    Vertices = pins.Add(vertices),
                    Triangles = pins.Add(triangles)
                };
                report = new MeshReport { Size = (uint)Marshal.SizeOf(typeof(MeshReport)) };
                IntPtr made;
                return new Surface(Native.nade_surface_create_mesh(ref mesh, ref report, out made), made);
            }
        }

        /// <summary>A shape of the program's own, kept while the surface is in use.</summary>
        public static Surface Custom(IShape shape)
        {
            Library.CheckAbi();
            if (shape == null) throw new ArgumentNullException("shape");
            var user = GCHandle.Alloc(shape);
            var callbacks = ShapeCalls.Of(shape, GCHandle.ToIntPtr(user));
            IntPtr made;
            var code = Native.nade_surface_create_custom(ref callbacks, out made);
            if (code != ErrorCode.Ok) user.Free();
            return new Surface(code, made);
        }

        /// <summary>Up to 255 surfaces as one, each with its placement in the group's frame.</summary>
        public static Surface Group(Surface[] members, Placement[] placements)
        {
            int count = members == null ? 0 : members.Length;
            if (count != (placements == null ? 0 : placements.Length))
            {
                throw new NadeException(ErrorCode.Argument,
                    "Surface.Group: placements: expected as many as members");
            }
            using (var pins = new Pins())
            {
                var list = new Native.GroupMember[count];
                for (int i = 0; i < count; ++i)
                {
                    list[i].Surface = pins.Add(members[i]);
                    list[i].Placement = placements[i];
                }
                IntPtr made;
                return new Surface(Native.nade_surface_create_group(list, (UIntPtr)(uint)count, out made),
                                   made);
            }
        }

        /// <summary>New positions for all vertices of a mesh, for any frame.</summary>
        public ErrorCode Refit(float[] vertices)
        {
            if (IsClosed) return ErrorCode.Handle;
            // What is no whole number of vertices is passed as none, and refused.
            int count = vertices == null || vertices.Length % 3 != 0 ? 0 : vertices.Length / 3;
            return Native.nade_surface_refit(this, vertices, Unsigned(count));
        }

        /// <summary>Moves a member of a group, in any frame.</summary>
        public ErrorCode PlaceMember(int index, Placement placement)
        {
            if (IsClosed) return ErrorCode.Handle;
            return Native.nade_surface_place_member(this, Unsigned(index), ref placement);
        }

        /// <summary>The point nearest to a query, world coordinates, of the placed surface.</summary>
        public ErrorCode ClosestPoint(Double3 query, double maxDistance, Placement placement,
                                      out SurfacePoint point, out bool found)
        {
            point = new SurfacePoint();
            int any = 0;
            var code = IsClosed ? ErrorCode.Handle : Native.nade_surface_closest_point(
                this, ref placement, ref query, maxDistance, ref point, ref any);
            found = any != 0;
            return code;
        }

        /// <summary>A number below 0 becomes one that is beyond every size.</summary>
        internal static UIntPtr Unsigned(int number)
        {
            return (UIntPtr)(number < 0 ? uint.MaxValue : (uint)number);
        }

        private static UIntPtr Count(Array numbers, int each, string name)
        {
            int length = numbers == null ? 0 : numbers.Length;
            if (length % each == 0) return (UIntPtr)(uint)(length / each);
            throw new NadeException(ErrorCode.Argument, "Surface: " + name + ": expected " + each
                + " numbers of each, found " + length + " in all");
        }
    }

    /// <summary>All objects that a hand may touch, hundreds of them, by ids of the program's own.
    /// Where solids overlap they are one.</summary>
    public sealed class Scene : NadeHandle
    {
        public Scene()
        {
            IntPtr made;
            Own(Native.nade_scene_create(out made), made);
        }

        protected override bool ReleaseHandle()
        {
            return Native.nade_scene_destroy(handle) == ErrorCode.Ok;
        }

        public void Add(ulong id, Surface surface, Placement placement, Feel? feel = null)
        {
            if (surface == null) throw new ArgumentNullException("surface");
            var given = feel ?? Feel.Default;
            given.Size = Feel.Bytes;
            Library.Must(Native.nade_scene_add(this, id, surface, ref placement, ref given));
        }

        public void Remove(ulong id) { Library.Must(Native.nade_scene_remove(this, id)); }

        public int Count
        {
            get
            {
                UIntPtr size;
                Library.Must(Native.nade_scene_size(this, out size));
                return (int)size;
            }
        }

        /// <summary>Moves, turns or scales an object, in any frame.</summary>
        public ErrorCode Place(ulong id, Placement placement)
        {
            return IsClosed ? ErrorCode.Handle : Native.nade_scene_place(this, id, ref placement);
        }

        /// <summary>The object's surface was refitted, or has other bounds.</summary>
        public ErrorCode Deformed(ulong id)
        {
            return IsClosed ? ErrorCode.Handle : Native.nade_scene_deformed(this, id);
        }

        /// <summary>How it feels from the next frame on.</summary>
        public ErrorCode SetFeel(ulong id, Feel feel)
        {
            feel.Size = Feel.Bytes;
            return IsClosed ? ErrorCode.Handle : Native.nade_scene_set_feel(this, id, ref feel);
        }
    }

    /// <summary>What can touch of a hand that a program draws itself, measured once.</summary>
    public sealed class Flesh : NadeHandle
    {
        /// <summary>The bind pose: x y z of each vertex and of its unit normal, three indices of each
        /// triangle, four bones (numbers of joints) and weights of each vertex, 26 joints.</summary>
        public Flesh(Side side, float[] vertices, float[] normals, int[] triangles, byte[] bones,
                     float[] weights, HandJoint[] bind)
        {
            using (var pins = new Pins())
            {
                var mesh = pins.HandMesh("Flesh", side, vertices, normals, triangles, bones, weights, bind);
                IntPtr made;
                Own(Native.nade_flesh_create(ref mesh, out made), made);
            }
        }

        protected override bool ReleaseHandle()
        {
            return Native.nade_flesh_destroy(handle) == ErrorCode.Ok;
        }
    }

    /// <summary>The skin of a hand as it is drawn: one for each hand. Where its flesh is sunk in an
    /// object it is flattened, so that none comes out on the other side of something thin.</summary>
    public sealed class Skin : NadeHandle
    {
        /// <summary>The mesh as for Flesh.</summary>
        public Skin(Side side, float[] vertices, float[] normals, int[] triangles, byte[] bones,
                    float[] weights, HandJoint[] bind)
        {
            using (var pins = new Pins())
            {
                var mesh = pins.HandMesh("Skin", side, vertices, normals, triangles, bones, weights, bind);
                IntPtr made;
                Own(Native.nade_skin_create(ref mesh, out made), made);
            }
        }

        protected override bool ReleaseHandle()
        {
            return Native.nade_skin_destroy(handle) == ErrorCode.Ok;
        }

        /// <summary>Where the joints carry the vertices, x y z of each, and their normals, which may be
        /// null. The scale is that of what is drawn over the mesh's own size.</summary>
        public ErrorCode Pose(HandJoint[] joints, double scale, float[] vertices, float[] normals)
        {
            if (IsClosed) return ErrorCode.Handle;
            return Native.nade_skin_pose(this, Library.WholeHand(joints), scale, vertices, normals,
                                         Count(vertices, normals));
        }

        /// <summary>Moves posed vertices out of a surface, null where none is near, and turns their
        /// normals along. The object is drawn pressed in by `give` under the hand; 0: as it is.
        /// </summary>
        public ErrorCode Flatten(HandJoint[] joints, double scale, Surface surface, Placement placement,
                                 double give, float[] vertices, float[] normals)
        {
            if (IsClosed || (surface != null && surface.IsClosed)) return ErrorCode.Handle;
            return Native.nade_skin_flatten(this, Library.WholeHand(joints), scale, surface ?? Surface.None,
                                            ref placement, give, vertices, normals,
                                            Count(vertices, normals));
        }

        /// <summary>The same out of all objects of a scene.</summary>
        public ErrorCode Flatten(HandJoint[] joints, double scale, Scene scene, double give,
                                 float[] vertices, float[] normals)
        {
            if (IsClosed || !CanBeUsed(scene)) return ErrorCode.Handle;
            return Native.nade_skin_flatten_scene(this, Library.WholeHand(joints), scale, scene, give,
                                                  vertices, normals, Count(vertices, normals));
        }

        /// <summary>What does not fit is passed as no vertices, and refused.</summary>
        private static UIntPtr Count(float[] vertices, float[] normals)
        {
            bool fits = vertices != null && vertices.Length % 3 == 0
                && (normals == null || normals.Length == vertices.Length);
            return (UIntPtr)(uint)(fits ? vertices.Length / 3 : 0);
        }
    }

    /// <summary>What a corrector does; new ones have the defaults.</summary>
    public sealed class CorrectorOptions
    {
        public Method Method;
        public double ReleaseS;     // what cannot be continuous fades over this time, 0 to 1
        public double HandLengthM;  // wrist to middle knuckle of the drawn hand; 0: as tracked
        public Feel? Feel;          // of objects outside of a scene
        public Flesh LeftFlesh;     // of the left hand that is drawn; null: the built-in hand's
        public Flesh RightFlesh;

        public CorrectorOptions()
        {
            Library.CheckAbi();
            var defaults = Native.CorrectorOptions.Sized;
            Library.Must(Native.nade_corrector_options_init(ref defaults));
            Method = defaults.Method;
            ReleaseS = defaults.ReleaseS;
            HandLengthM = defaults.HandLengthM;
        }

        /// <summary>Throws what a corrector with these options would.</summary>
        public void Check()
        {
            Use((ref Native.CorrectorOptions options) =>
                Native.nade_corrector_options_check(ref options));
        }

        internal delegate ErrorCode User(ref Native.CorrectorOptions options);

        internal void Use(User user)
        {
            using (var pins = new Pins())
            {
                var options = Native.CorrectorOptions.Sized;
                options.Method = Method;
                options.ReleaseS = ReleaseS;
                options.HandLengthM = HandLengthM;
                if (Feel.HasValue)
                {
                    var feel = Feel.Value;
                    feel.Size = Nade.Feel.Bytes;
                    options.Feel = pins.Add(new[] { feel });
                }
                options.LeftFlesh = pins.Add(LeftFlesh);
                options.RightFlesh = pins.Add(RightFlesh);
                Library.Must(user(ref options));
            }
        }
    }

    /// <summary>A corrected hand; made once, filled by every frame.</summary>
    public sealed class CorrectedHand
    {
        public HandStatus Status { get; private set; }
        public Fault Fault { get; private set; }
        public int ContactCount { get; private set; }
        public readonly HandJoint[] Joints = new HandJoint[Library.JointCount]; // to draw
        public readonly Float3[] VelocitiesMps = new Float3[Library.JointCount]; // of them
        public readonly Contact[] Contacts = new Contact[Library.MaxContacts]; // the first ContactCount

        // A nade_result, as words; the same as floats.
        internal const int Words = 4 + 8 * Library.JointCount + 3 * Library.JointCount
                                   + ContactWords * Library.MaxContacts;
        private const int ContactWords = 14;
        internal readonly int[] Raw = new int[Words];
        private readonly float[] floats = new float[Words];

        internal CorrectedHand Sized()
        {
            Raw[0] = sizeof(int) * Words;
            return this;
        }

        internal void Read()
        {
            Buffer.BlockCopy(Raw, 0, floats, 0, sizeof(int) * Words);
            Status = (HandStatus)Raw[1];
            Fault = (Fault)Raw[2];
            ContactCount = Raw[3];
            int at = 4;
            for (int i = 0; i < Joints.Length; ++i, at += 8)
            {
                Joints[i].Rotation = new Float4(floats[at], floats[at + 1], floats[at + 2], floats[at + 3]);
                Joints[i].Position = At(at + 4);
                Joints[i].Radius = floats[at + 7];
            }
            for (int i = 0; i < VelocitiesMps.Length; ++i, at += 3) VelocitiesMps[i] = At(at);
            for (int i = 0; i < Contacts.Length; ++i, at += ContactWords) ReadContact(ref Contacts[i], at);
        }

        private void ReadContact(ref Contact contact, int at)
        {
            contact.Object = (uint)Raw[at] | (ulong)(uint)Raw[at + 1] << 32;
            contact.Bone = (JointIndex)Raw[at + 2];
            contact.DepthM = floats[at + 3];
            contact.Point = At(at + 4);
            contact.Normal = At(at + 7);
            contact.VelocityMps = At(at + 10);
        }

        private Float3 At(int at) { return new Float3(floats[at], floats[at + 1], floats[at + 2]); }
    }

    /// <summary>Corrects one hand, frame by frame: one for each hand.</summary>
    public sealed class Corrector : NadeHandle
    {
        public Corrector(CorrectorOptions options = null)
        {
            IntPtr made = IntPtr.Zero;
            (options ?? new CorrectorOptions()).Use((ref Native.CorrectorOptions given) =>
                Native.nade_corrector_create(ref given, out made));
            Own(ErrorCode.Ok, made);
        }

        protected override bool ReleaseHandle()
        {
            return Native.nade_corrector_destroy(handle) == ErrorCode.Ok;
        }

        /// <summary>As below, of an object that does not move.</summary>
        public ErrorCode Update(Side side, HandJoint[] tracked, Surface surface, long timeNs,
                                CorrectedHand hand)
        {
            return Update(side, tracked, surface, Placement.Identity, 0, timeNs, hand);
        }

        /// <summary>The hand to draw for a tracked hand that may touch one surface; null where none is
        /// near. The 26 joints are as tracked, never as drawn; a hand that is not tracked is not passed
        /// at all. Any number tells objects that share a surface apart.</summary>
        public ErrorCode Update(Side side, HandJoint[] tracked, Surface surface, Placement placement,
                                ulong objectId, long timeNs, CorrectedHand hand)
        {
            if (surface == null) surface = Surface.None;
            if (IsClosed || surface.IsClosed) return ErrorCode.Handle;
            if (hand == null) return ErrorCode.Argument;
            var code = Native.nade_corrector_update(this, side, Library.WholeHand(tracked), surface,
                                                    ref placement, objectId, timeNs, hand.Sized().Raw);
            if (code == ErrorCode.Ok) hand.Read();
            return code;
        }

        /// <summary>The same for a hand that may touch any object of a scene.</summary>
        public ErrorCode Update(Side side, HandJoint[] tracked, Scene scene, long timeNs,
                                CorrectedHand hand)
        {
            if (IsClosed || !CanBeUsed(scene)) return ErrorCode.Handle;
            if (hand == null) return ErrorCode.Argument;
            var code = Native.nade_corrector_update_scene(this, side, Library.WholeHand(tracked), scene,
                                                          timeNs, hand.Sized().Raw);
            if (code == ErrorCode.Ok) hand.Read();
            return code;
        }

        /// <summary>The latest correction on a newer pose of the same hand, for a picture's late
        /// update; drawn may be tracked.</summary>
        public ErrorCode Preview(Side side, HandJoint[] tracked, HandJoint[] drawn)
        {
            if (IsClosed) return ErrorCode.Handle;
            return Native.nade_corrector_preview(this, side, Library.WholeHand(tracked),
                                                 Library.WholeHand(drawn));
        }

        /// <summary>How objects outside of a scene feel from the next frame on.</summary>
        public ErrorCode SetFeel(Feel feel)
        {
            feel.Size = Feel.Bytes;
            return IsClosed ? ErrorCode.Handle : Native.nade_corrector_set_feel(this, ref feel);
        }

        /// <summary>Forgets everything about the hand so far.</summary>
        public ErrorCode Reset() { return IsClosed ? ErrorCode.Handle : Native.nade_corrector_reset(this); }
    }

    /// <summary>Holds arrays in place, and handles open, while a call reads them.</summary>
    internal sealed class Pins : IDisposable
    {
        private readonly System.Collections.Generic.List<GCHandle> arrays =
            new System.Collections.Generic.List<GCHandle>();
        private readonly System.Collections.Generic.List<NadeHandle> handles =
            new System.Collections.Generic.List<NadeHandle>();

        internal IntPtr Add(Array array)
        {
            if (array == null) return IntPtr.Zero;
            var pin = GCHandle.Alloc(array, GCHandleType.Pinned);
            arrays.Add(pin);
            return pin.AddrOfPinnedObject();
        }

        internal IntPtr Add(NadeHandle handle)
        {
            if (handle == null) return IntPtr.Zero;
            bool added = false;
            handle.DangerousAddRef(ref added);
            handles.Add(handle);
            return handle.DangerousGetHandle();
        }

        internal Native.HandMesh HandMesh(string what, Side side, float[] vertices, float[] normals,
                                          int[] triangles, byte[] bones, float[] weights, HandJoint[] bind)
        {
            int count = vertices == null ? 0 : vertices.Length / 3;
            Expect(normals, 3 * count, what + ": normals");
            Expect(bones, 4 * count, what + ": bones");
            Expect(weights, 4 * count, what + ": weights");
            Expect(bind, Library.JointCount, what + ": bind");
            return new Native.HandMesh
            {
                Size = (uint)Marshal.SizeOf(typeof(Native.HandMesh)),
                Side = side,
                VertexCount = (uint)count,
                TriangleCount = triangles == null ? 0 : (uint)triangles.Length / 3,
                Vertices = Add(vertices),
                Normals = Add(normals),
                Triangles = Add(triangles),
                Bones = Add(bones),
                Weights = Add(weights),
                Bind = Add(bind)
            };
        }

        private static void Expect(Array array, int length, string name)
        {
            int found = array == null ? 0 : array.Length;
            if (found == length) return;
            throw new NadeException(ErrorCode.Argument,
                name + ": expected " + length + ", found " + found);
        }

        public void Dispose()
        {
            foreach (var pin in arrays) pin.Free();
            foreach (var handle in handles) handle.DangerousRelease();
        }
    }

    /// <summary>What a compiler ahead of time (Unity's IL2CPP) asks for, by this name.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type) { }
    }

    /// <summary>The library's questions, passed on to a shape.</summary>
    internal static class ShapeCalls
    {
        private static readonly Native.ClosestPointCallback closestPoint = ClosestPoint;
        private static readonly Native.FirstHitCallback firstHit = FirstHit;
        private static readonly Native.ShapeCallback shapeNumber = ShapeNumber;
        private static readonly Native.BoundsCallback bounds = Bounds;
        private static readonly Native.ReleaseCallback release = Release;

        internal static Native.SurfaceCallbacks Of(IShape shape, IntPtr user)
        {
            return new Native.SurfaceCallbacks
            {
                Size = (uint)Marshal.SizeOf(typeof(Native.SurfaceCallbacks)),
                User = user,
                ClosestPoint = Marshal.GetFunctionPointerForDelegate(closestPoint),
                FirstHit = shape is IRayShape ? Marshal.GetFunctionPointerForDelegate(firstHit) : IntPtr.Zero,
                Shape = shape is IChangingShape
                    ? Marshal.GetFunctionPointerForDelegate(shapeNumber) : IntPtr.Zero,
                Bounds = shape is IBoundedShape ? Marshal.GetFunctionPointerForDelegate(bounds) : IntPtr.Zero,
                Release = Marshal.GetFunctionPointerForDelegate(release)
            };
        }

        private static object Of(IntPtr user) { return GCHandle.FromIntPtr(user).Target; }

        [MonoPInvokeCallback(typeof(Native.ClosestPointCallback))]
        private static int ClosestPoint(IntPtr user, ref Double3 query, double maxDistance, ref uint hint,
                                        ref SurfacePoint point)
        {
            try
            {
                SurfacePoint found;
                if (!((IShape)Of(user)).ClosestPoint(query, maxDistance, ref hint, out found)) return 0;
                point = found;
                return 1;
            }
            catch (Exception) { return 0; } // the library's frames know no exceptions
        }

        [MonoPInvokeCallback(typeof(Native.FirstHitCallback))]
        private static int FirstHit(IntPtr user, ref Double3 origin, ref Double3 direction,
                                    double maxDistance, ref RayHit hit)
        {
            try
            {
                RayHit found;
                if (!((IRayShape)Of(user)).FirstHit(origin, direction, maxDistance, out found)) return 0;
                hit = found;
                return 1;
            }
            catch (Exception) { return 0; }
        }

        [MonoPInvokeCallback(typeof(Native.ShapeCallback))]
        private static ulong ShapeNumber(IntPtr user)
        {
            try { return ((IChangingShape)Of(user)).Shape; }
            catch (Exception) { return 0; }
        }

        [MonoPInvokeCallback(typeof(Native.BoundsCallback))]
        private static int Bounds(IntPtr user, ref Double3 low, ref Double3 high)
        {
            try
            {
                Double3 from, to;
                if (!((IBoundedShape)Of(user)).Bounds(out from, out to)) return 0;
                low = from;
                high = to;
                return 1;
            }
            catch (Exception) { return 0; }
        }

        [MonoPInvokeCallback(typeof(Native.ReleaseCallback))]
        private static void Release(IntPtr user) { GCHandle.FromIntPtr(user).Free(); }
    }

    /// <summary>nade.h.</summary>
    internal static class Native
    {
        private const string Nade = "nade";
        private const CallingConvention C = CallingConvention.Cdecl;

        [UnmanagedFunctionPointer(C)]
        internal delegate void MessageCallback(IntPtr user, ErrorCode code, IntPtr sentence);
        [UnmanagedFunctionPointer(C)]
        internal delegate int ClosestPointCallback(IntPtr user, ref Double3 query, double maxDistance,
                                                   ref uint hint, ref SurfacePoint point);
        [UnmanagedFunctionPointer(C)]
        internal delegate int FirstHitCallback(IntPtr user, ref Double3 origin, ref Double3 direction,
                                               double maxDistance, ref RayHit hit);
        [UnmanagedFunctionPointer(C)]
        internal delegate ulong ShapeCallback(IntPtr user);
        [UnmanagedFunctionPointer(C)]
        internal delegate int BoundsCallback(IntPtr user, ref Double3 low, ref Double3 high);
        [UnmanagedFunctionPointer(C)]
        internal delegate void ReleaseCallback(IntPtr user);

        [StructLayout(LayoutKind.Sequential)]
        internal struct CorrectorOptions
        {
            internal uint Size;
            internal Method Method;
            internal double ReleaseS, HandLengthM;
            internal IntPtr Feel, LeftFlesh, RightFlesh;

            internal static CorrectorOptions Sized
            {
                get
                {
                    return new CorrectorOptions { Size = (uint)Marshal.SizeOf(typeof(CorrectorOptions)) };
                }
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Mesh
        {
            internal uint Size, VertexCount, TriangleCount;
            internal Float3 Scale;
            internal IntPtr Vertices, Triangles;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct SurfaceCallbacks
        {
            internal uint Size, Reserved;
            internal IntPtr User, ClosestPoint, FirstHit, Shape, Bounds, Release;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct GroupMember
        {
            internal IntPtr Surface;
            internal Placement Placement;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct HandMesh
        {
            internal uint Size;
            internal Side Side;
            internal uint VertexCount, TriangleCount;
            internal IntPtr Vertices, Normals, Triangles, Bones, Weights, Bind;
        }

        [DllImport(Nade, CallingConvention = C)] internal static extern uint nade_abi_version();
        [DllImport(Nade, CallingConvention = C)] internal static extern IntPtr nade_version();
        [DllImport(Nade, CallingConvention = C)] internal static extern int nade_has(Capability capability);
        [DllImport(Nade, CallingConvention = C)] internal static extern IntPtr nade_status_text(ErrorCode code);
        [DllImport(Nade, CallingConvention = C)] internal static extern IntPtr nade_fault_text(Fault fault);
        [DllImport(Nade, CallingConvention = C)] internal static extern IntPtr nade_last_error();
        [DllImport(Nade, CallingConvention = C)] internal static extern void nade_set_message_callback(
            MessageCallback callback, IntPtr user);

        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_plane(
            out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_plate(
            float[] outlineXZ, UIntPtr count, double thickness, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_sphere(
            double radius, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_ellipsoid(
            ref Double3 halfAxes, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_box(
            ref Double3 halfSize, double rounding, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_cylinder(
            double halfHeight, double radius, double rounding, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_capsule(
            double length, double radius, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_hull(
            float[] points, UIntPtr count, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_height_field(
            float[] heights, UIntPtr columns, UIntPtr rows, double step, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_mesh(
            ref Mesh mesh, ref MeshReport report, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_custom(
            ref SurfaceCallbacks callbacks, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_create_group(
            [In] GroupMember[] members, UIntPtr count, out IntPtr surface);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_refit(
            Surface mesh, float[] vertices, UIntPtr vertexCount);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_place_member(
            Surface group, UIntPtr index, ref Placement placement);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_closest_point(
            Surface surface, ref Placement placement, ref Double3 query, double maxDistance,
            ref SurfacePoint point, ref int found);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_surface_destroy(
            IntPtr surface);

        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_create(
            out IntPtr scene);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_add(
            Scene scene, ulong id, Surface surface, ref Placement placement, ref Feel feel);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_place(
            Scene scene, ulong id, ref Placement placement);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_deformed(
            Scene scene, ulong id);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_set_feel(
            Scene scene, ulong id, ref Feel feel);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_remove(
            Scene scene, ulong id);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_size(
            Scene scene, out UIntPtr size);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_scene_destroy(
            IntPtr scene);

        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_rest_hand(
            Side side, [Out] HandJoint[] joints);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_flesh_create(
            ref HandMesh mesh, out IntPtr flesh);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_flesh_destroy(
            IntPtr flesh);

        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_feel_init(
            ref Feel feel);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_options_init(
            ref CorrectorOptions options);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_options_check(
            ref CorrectorOptions options);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_create(
            ref CorrectorOptions options, out IntPtr corrector);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_update(
            Corrector corrector, Side side, [In] HandJoint[] joints, Surface surface,
            ref Placement placement, ulong objectId, long timeNs, [In, Out] int[] result);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_update_scene(
            Corrector corrector, Side side, [In] HandJoint[] joints, Scene scene, long timeNs,
            [In, Out] int[] result);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_preview(
            Corrector corrector, Side side, [In] HandJoint[] joints, [In, Out] HandJoint[] drawn);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_set_feel(
            Corrector corrector, ref Feel feel);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_reset(
            Corrector corrector);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_corrector_destroy(
            IntPtr corrector);

        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_skin_create(
            ref HandMesh mesh, out IntPtr skin);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_skin_pose(
            Skin skin, [In] HandJoint[] joints, double scale, [In, Out] float[] vertices,
            [In, Out] float[] normals, UIntPtr vertexCount);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_skin_flatten(
            Skin skin, [In] HandJoint[] joints, double scale, Surface surface, ref Placement placement,
            double give, [In, Out] float[] vertices, [In, Out] float[] normals, UIntPtr vertexCount);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_skin_flatten_scene(
            Skin skin, [In] HandJoint[] joints, double scale, Scene scene, double give,
            [In, Out] float[] vertices, [In, Out] float[] normals, UIntPtr vertexCount);
        [DllImport(Nade, CallingConvention = C)] internal static extern ErrorCode nade_skin_destroy(
            IntPtr skin);
    }
}
