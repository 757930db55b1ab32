// Layers that are not lit are exported once and shown as drawn.
#include "plugin/unlit_layers.h"
#include "support/fake_host.h"
#include "support/fake_worker.h"

using namespace lampblack;

namespace
{

Layer layer(const char* name, bool visible = true)
{
    return {QLatin1String(name), Layer::Kind::Bitmap, visible};
}

/// Each layer in a colour of its own.
QImage plate(const QStringList& layers)
{
    QImage image(4, 4, QImage::Format_RGBA8888);
    image.fill(QColor::fromHsv(layers.join(QLatin1Char(' ')).size() * 7 % 360, 255, 255));
    return image;
}

const LayerRoles Roles = {{QStringLiteral("Fox"), QStringLiteral("character")},
                          {QStringLiteral("Ink"), QStringLiteral("line")},
                          {QStringLiteral("Hills"), QStringLiteral("background")}};

} // namespace

class UnlitLayersTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layersAreSortedAsTheCommandLineSortsThem()
    {
        const LayerStack all = sortLayers({layer("Ink"), layer("Fox"), layer("Gone", false)}, {});
        QCOMPARE(all.lit, (QStringList{QStringLiteral("Ink"), QStringLiteral("Fox")}));
        QVERIFY(all.above.isEmpty() && all.below.isEmpty());

        // Once one is a character, what has no role is background; between two that are lit, it is under
        // both.
        const LayerStack some = sortLayers(
            {layer("Rain"), layer("Ink"), layer("Mist"), layer("Fox"), layer("Hills"), layer("Sky", false)},
            Roles);
        QCOMPARE(some.above, QStringList{QStringLiteral("Rain")});
        QCOMPARE(some.lit, (QStringList{QStringLiteral("Ink"), QStringLiteral("Fox")}));
        QCOMPARE(some.below, (QStringList{QStringLiteral("Mist"), QStringLiteral("Hills")}));
    }

    void paintedLightIsNoPartOfThePicture()
    {
        const LayerStack stack = sortLayers({layer("Light"), layer("Fox")}, {});
        QCOMPARE(stack.lit, QStringList{QStringLiteral("Fox")});
        QVERIFY(stack.above.isEmpty() && stack.below.isEmpty());
        const LayerRoles drawn = {{QStringLiteral("Light"), QStringLiteral("character")}};
        QCOMPARE(sortLayers({layer("Light")}, drawn).lit, QStringList{QStringLiteral("Light")});
    }

    void sourcesHiddenBehindTheirResultAreLit()
    {
        const LayerStack stack =
            sortLayers({layer("Lit"), layer("Fox", false), layer("Sketch", false)}, Roles);
        QCOMPARE(stack.lit, QStringList{QStringLiteral("Fox")});
        QVERIFY(stack.above.isEmpty() && stack.below.isEmpty());
    }

    void eachPlateIsAskedForOnceAndKnownWhenItCame()
    {
        FakeHost host;
        host.mDraw = [](int, const QStringList& layers)
        {
            return plate(layers);
        };
        FakeWorker worker;
        SceneDocument document;
        host.mLayers = {layer("Rain"), layer("Ink"), layer("Fox"), layer("Hills")};
        document.setLayerRoles(Roles);
        FrameFeed feed(host, worker, document);
        const UnlitLayers unlit(host, feed, document);
        QVERIFY(!unlit.isLoaded(1));
        feed.setEnabled(true);
        QVERIFY(unlit.isLoaded(1));
        QCOMPARE(unlit.below(1).layers, QStringList{QStringLiteral("Hills")});
        QCOMPARE(unlit.above(1).layers, QStringList{QStringLiteral("Rain")});
        // What is lit comes first, and the worker gets nothing else.
        QCOMPARE(host.mRequests.size(), 5);
        QCOMPARE(host.mRequests[2].layers, (QStringList{QStringLiteral("Ink"), QStringLiteral("Fox")}));
        QCOMPARE(worker.mPut, QVector<int>{1});

        feed.requestAll(1, 2);
        QCOMPARE(host.mRequests.size(), 10);
        // The same background in all frames is kept once.
        QCOMPARE(unlit.below(1).image.cacheKey(), unlit.below(2).image.cacheKey());

        Q_EMIT host.drawingChanged(1);
        QCOMPARE(host.mRequests.size(), 15);
    }

    void whatCannotBeHadDoesNotKeepTheLightAway()
    {
        FakeHost host;
        const QStringList broken{QStringLiteral("Hills")};
        host.mDraw = [&broken](int, const QStringList& layers)
        {
            return layers == broken ? QImage() : plate(layers);
        };
        FakeWorker worker;
        SceneDocument document;
        host.mLayers = {layer("Fox"), layer("Hills")};
        document.setLayerRoles(Roles);
        FrameFeed feed(host, worker, document);
        const UnlitLayers unlit(host, feed, document);
        feed.setEnabled(true);
        QVERIFY(unlit.isLoaded(1));
        QVERIFY(unlit.below(1).image.isNull());
    }
};

QTEST_MAIN(UnlitLayersTest)
#include "test_unlit_layers.moc"
