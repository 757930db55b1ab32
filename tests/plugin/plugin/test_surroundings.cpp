// Layers that are not lit, from a host that exports at once what it is asked for.
#include "plugin/surroundings.h"
#include "tool/fakes.h"

using namespace lampblack;

namespace
{

Layer layer(const char* name, bool visible = true)
{
    return {QLatin1String(name), Layer::Kind::Bitmap, visible};
}

/// Paints each layer in a colour of its own.
class PlateHost : public FakeHost
{
public:
    void requestFrames(int first, int last, const QStringList& layers) override
    {
        for (int frame = first; frame <= last; ++frame)
        {
            mAsked.append({frame, layers});
            if (layers == mBroken)
            {
                Q_EMIT exportFailed(frame, {});
                continue;
            }
            QImage image(4, 4, QImage::Format_RGBA8888);
            image.fill(QColor::fromHsv(layers.join(QLatin1Char(' ')).size() * 7 % 360, 255, 255));
            Q_EMIT frameExported({frame, image, {}, layers});
        }
    }

    QVector<QPair<int, QStringList>> mAsked;
    QStringList mBroken;
};

const LayerRoles Roles = {{QStringLiteral("Fox"), QStringLiteral("character")},
                          {QStringLiteral("Ink"), QStringLiteral("line")},
                          {QStringLiteral("Hills"), QStringLiteral("background")}};

} // namespace

class SurroundingsTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layersAreSortedAsTheCommandLineSortsThem()
    {
        const LayerStack all = stackLayers({layer("Ink"), layer("Fox"), layer("Gone", false)}, {});
        QCOMPARE(all.lit, (QStringList{QStringLiteral("Ink"), QStringLiteral("Fox")}));
        QVERIFY(all.above.isEmpty() && all.below.isEmpty());

        // Once one is a character, what has no role is background; between two that are lit, it is under
        // both.
        const LayerStack some = stackLayers(
            {layer("Rain"), layer("Ink"), layer("Mist"), layer("Fox"), layer("Hills"), layer("Sky", false)},
            Roles);
        QCOMPARE(some.above, QStringList{QStringLiteral("Rain")});
        QCOMPARE(some.lit, (QStringList{QStringLiteral("Ink"), QStringLiteral("Fox")}));
        QCOMPARE(some.below, (QStringList{QStringLiteral("Mist"), QStringLiteral("Hills")}));
    }

    void sourcesHiddenBehindTheirResultAreLit()
    {
        const LayerStack stack =
            stackLayers({layer("Lit"), layer("Fox", false), layer("Sketch", false)}, Roles);
        QCOMPARE(stack.lit, QStringList{QStringLiteral("Fox")});
        QVERIFY(stack.above.isEmpty() && stack.below.isEmpty());
    }

    void eachPlateIsAskedForOnceAndKnownWhenItCame()
    {
        PlateHost host;
        FakeWorker worker;
        SceneDocument document;
        host.mLayers = {layer("Rain"), layer("Ink"), layer("Fox"), layer("Hills")};
        document.setLayerRoles(Roles);
        FrameFeed feed(host, worker, document);
        const Surroundings around(host, feed, document);
        QVERIFY(!around.isKnown(1));
        feed.setOn(true);
        QVERIFY(around.isKnown(1));
        QCOMPARE(around.below(1).layers, QStringList{QStringLiteral("Hills")});
        QCOMPARE(around.above(1).layers, QStringList{QStringLiteral("Rain")});
        // What is lit comes first, and the worker gets nothing else.
        QCOMPARE(host.mAsked.size(), 3);
        QCOMPARE(host.mAsked[0].second, (QStringList{QStringLiteral("Ink"), QStringLiteral("Fox")}));
        QCOMPARE(worker.mPut, QVector<int>{1});

        feed.wantAll(1, 2);
        QCOMPARE(host.mAsked.size(), 6);
        // The same background in all frames is kept once.
        QCOMPARE(around.below(1).image.cacheKey(), around.below(2).image.cacheKey());

        Q_EMIT host.drawingChanged(1);
        QCOMPARE(host.mAsked.size(), 9);
    }

    void whatCannotBeHadDoesNotKeepTheLightAway()
    {
        PlateHost host;
        FakeWorker worker;
        SceneDocument document;
        host.mLayers = {layer("Fox"), layer("Hills")};
        host.mBroken = QStringList{QStringLiteral("Hills")};
        document.setLayerRoles(Roles);
        FrameFeed feed(host, worker, document);
        const Surroundings around(host, feed, document);
        feed.setOn(true);
        QVERIFY(around.isKnown(1));
        QVERIFY(around.below(1).image.isNull());
    }
};

QTEST_MAIN(SurroundingsTest)
#include "test_surroundings.moc"
