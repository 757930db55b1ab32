// The canvas is lit while the lamp is in use, by a picture of the worker or by what stands in for it.
#include "plugin/stand_ins.h"
#include "support/scenes.h"
#include "support/studio_test.h"

#include <QAbstractButton>

#include <cmath>

using namespace lampblack;

class AlwaysLitTest : public StudioTest
{
    Q_OBJECT

private:
    /// What the drawing program shows.
    void paintCanvas(const QColor& colour)
    {
        QPalette palette;
        palette.setColor(QPalette::Window, colour);
        mHost->mCanvas->setAutoFillBackground(true);
        mHost->mCanvas->setPalette(palette);
    }

private Q_SLOTS:
    void drawingThatStaysTheSameStaysLit()
    {
        // A selection made and lifted, or a project saved under another name.
        openLit();
        mHost->mDraw = {};
        Q_EMIT mHost->drawingChanged(1);
        QVERIFY2(showsPicture(), "until it is known what the frame shows");
        QVERIFY(!isReady());
        exportAll(mWorker->mKnown[1]);
        QVERIFY(showsPicture() && mStudio->isSettled() && isReady());
    }

    void layersThatComeAndGoLeaveTheLight()
    {
        openLit();
        mHost->mDraw = {};
        const QImage drawing = mWorker->mKnown[1];
        Q_EMIT mHost->layersChanged();
        QCOMPARE(mWorker->mDropped, 1);
        QVERIFY(showsPicture() && !isReady());
        exportAll(drawing);
        QVERIFY(showsPicture() && mStudio->isSettled());
    }

    void heldDrawingIsReadAgainInAllItsFrames()
    {
        mHost->mDraw = [this](int frame, const QStringList&)
        {
            return drawing(QColor::fromHsv(mStrokes, frame > 2 ? 200 : 100, 200));
        };
        openLit();
        for (const int frame : {3, 2, 1})
            mHost->goToFrame(frame);
        QCOMPARE(mWorker->mPut, (QVector<int>{1, 3, 2}));
        mWorker->mPut.clear();
        draw(); // on frame 1, which is held in frame 2
        for (const int frame : {2, 3})
        {
            mHost->goToFrame(frame);
            QTest::qWait(20);
        }
        QCOMPARE(mWorker->mPut, (QVector<int>{1, 2}));
    }

    void aDrawingThatWasLitIsShadedByItsRealSurface()
    {
        FakeWorker worker;
        SceneDocument document;
        document.reset(sceneWithLight(20, 150, 100));
        FrameFeed feed(*mHost, worker, document);
        UnlitLayers unlit(*mHost, feed, document);
        StandIns standIns(*mHost, worker, feed, unlit, document);
        feed.setEnabled(true);
        const auto shaded = [&standIns]
        {
            return standIns.current()->picture.picture;
        };
        const auto left = [](const QImage& picture)
        {
            return picture.pixelColor(130 * picture.width() / 400, picture.height() / 2).lightness();
        };
        const QImage guess = shaded();
        Q_EMIT worker.imageArrived(worker.pictureOf(1));
        Q_EMIT worker.imageArrived(worker.pictureOf(1));
        QCOMPARE(worker.mNormals, QVector<int>{1});
        QImage turnedAway(16, 12, QImage::Format_RGBA8888_Premultiplied);
        turnedAway.fill(QColor(255, 127, 127));
        Q_EMIT worker.normalsArrived(1, turnedAway);
        QVERIFY(left(shaded()) < left(guess) - 20);
        Scene brighter = document.scene();
        brighter.ambient.strength = 0.9;
        document.edit(QString(), brighter);
        QVERIFY2(left(shaded()) > left(guess) - 20, "under another light, by the same surface");
        document.undoStack()->undo();
        QVERIFY(left(shaded()) < left(guess) - 20);

        // Another drawing is guessed again, until it was lit.
        ++mStrokes;
        Q_EMIT mHost->drawingChanged(1);
        QVERIFY(left(shaded()) >= left(guess) - 5);
        Q_EMIT worker.imageArrived(worker.pictureOf(1));
        QCOMPARE(worker.mNormals, (QVector<int>{1, 1}));
    }

    void aDrawingThatWasLitHasRimsOnItsPartsInFront()
    {
        FakeWorker worker;
        SceneDocument document;
        Scene scene = sceneWithLight(20, 150, 100);
        scene.rim = Rim{20, Qt::white, 1, 0, {}};
        document.reset(scene);
        FrameFeed feed(*mHost, worker, document);
        UnlitLayers unlit(*mHost, feed, document);
        StandIns standIns(*mHost, worker, feed, unlit, document);
        feed.setEnabled(true);
        const auto lightness = [&standIns](int x)
        {
            const QImage picture = standIns.current()->picture.picture;
            return picture.pixelColor(x * picture.width() / 400, picture.height() / 2).lightness();
        };
        const int before = lightness(190);
        const int behind = lightness(210);
        Q_EMIT worker.imageArrived(worker.pictureOf(1));
        QCOMPARE(worker.mOverlaps, QVector<int>{1});
        const Overlap overlap{{{200, 250}, {200, 50}}, FrontSide::Left, 20, false};
        Q_EMIT worker.overlapsArrived(1, {overlap});
        QVERIFY(lightness(190) > before + 20);
        QCOMPARE(lightness(210), behind);
    }

    void anotherProjectIsNotShownInTheLightOfTheLast()
    {
        openLit();
        mHost->mDraw = {};
        Q_EMIT mHost->projectOpened({});
        QVERIFY(!showsPicture() && !showsStandIn() && !isReady());
    }

    void pictureThatDoesNotComeIsAskedForAgain()
    {
        mHost->open();
        QTRY_COMPARE(mWorker->mPreviews.size(), 1);
        QVERIFY(!isReady());
        const int cancelled = mWorker->mPreviewsCancelled;
        QTRY_COMPARE(mWorker->mPreviews.size(), 2);
        QCOMPARE(mWorker->mPreviewsCancelled, cancelled + 1); // so that the second is not taken for the first
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(isReady());
        mHost->goToFrame(2);
        QVERIFY2(!isReady(), "nothing is Ready while the frame is not lit");
        QTRY_COMPARE(mWorker->mPreviews.last().frame, 2);
    }

    void standInFollowsTheLight()
    {
        mHost->open();
        QTRY_VERIFY(showsStandIn());
        const auto shown = [this]
        {
            return qGreen(mHost->mCanvas->grab().toImage().pixel(160, 110));
        };
        setPower(0.1);
        const int before = shown();
        setPower(0.5);
        QVERIFY2(shown() > before + 10, "at once");
    }

    void standInIsOfTheDrawingUnderTheNewScene()
    {
        openLit();
        const auto middle = [this]
        {
            return QColor(mHost->mCanvas->grab().toImage().pixel(200, 150));
        };
        QCOMPARE(middle(), QColor(Qt::red)); // the picture of the worker
        mStrokes = 120;
        draw();
        QTRY_VERIFY(showsStandIn());
        QVERIFY(middle().green() > 1.2 * middle().red());
    }

    void pictureThatDoesNotReachFarEnoughIsContinued()
    {
        openLit();
        PreviewImage part = mWorker->pictureOf(1);
        part.crop = QRectF(0, 0, 200, 300);
        Q_EMIT mWorker->imageArrived(part);
        QVERIFY(showsPicture() && !isReady());
        const QImage shown = mHost->mCanvas->grab().toImage();
        QCOMPARE(QColor(shown.pixel(150, 150)), QColor(Qt::red));
        const QColor drawn(drawing(QColor::fromHsv(0, 101, 200)).pixel(260, 150));
        QVERIFY(shown.pixel(260, 150) != drawn.rgb());
        QVERIFY(qRed(shown.pixel(260, 150)) < drawn.red());
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QVERIFY(isReady());
    }

    void emptyPageIsReady()
    {
        mHost->mDraw = [](int, const QStringList&)
        {
            QImage image(400, 300, QImage::Format_RGBA8888);
            image.fill(Qt::transparent);
            return image;
        };
        mHost->open();
        QTRY_COMPARE(mWorker->mPut.size(), 1);
        QTRY_VERIFY(isReady());
        QVERIFY(!showsStandIn());
    }

    void flatViewIsReady()
    {
        openLit();
        find<QAbstractButton>("panel.view.flat")->click();
        QVERIFY(!showsPicture() && isReady());
        mHost->goToFrame(2);
        QVERIFY(isReady());
    }

    void lightStaysWhileTheArtistDraws()
    {
        openLit();
        const auto middle = [this]
        {
            return QColor(mHost->mCanvas->grab().toImage().pixel(200, 150));
        };
        // Half of what is drawn, which is (200, 121, 121).
        PreviewImage half = mWorker->pictureOf(1);
        half.picture = drawing(QColor(100, 60, 60)).convertToFormat(QImage::Format_RGBA8888_Premultiplied);
        Q_EMIT mWorker->imageArrived(half);
        paintCanvas(Qt::white);
        mHost->mTool->setChecked(false);
        QTRY_COMPARE_WITH_TIMEOUT(std::abs(middle().red() - 127) < 5, true, 5000);
        QCOMPARE(QColor(mHost->mCanvas->grab().toImage().pixel(20, 20)), QColor(Qt::white));
        paintCanvas(QColor(40, 200, 40)); // a stroke
        QVERIFY(std::abs(middle().green() - 100) < 5 && middle().red() < 25);

        const int put = mWorker->mPut.size();
        draw();
        QCOMPARE(mWorker->mPut.size(), put);
        QVERIFY2(std::abs(middle().green() - 100) < 5, "until its own light comes");
        QTRY_COMPARE(mWorker->mPut.size(), put + 1); // after a pause
        QVERIFY(std::abs(middle().green() - 100) < 5);
        Q_EMIT mWorker->imageArrived(mWorker->pictureOf(1));
        QTRY_VERIFY(middle().green() < 20);

        setKeepsLight(false);
        QCOMPARE(middle(), QColor(40, 200, 40));
        setKeepsLight(true);
        QTRY_VERIFY(middle().green() < 20);
    }

    void lightIsNotPutOnLitFrames()
    {
        openLit();
        paintCanvas(Qt::white);
        mHost->mLayers.prepend({QStringLiteral("Lit"), Layer::Kind::Bitmap, true});
        Q_EMIT mHost->layersChanged();
        mHost->mTool->setChecked(false);
        QTest::qWait(50);
        QCOMPARE(QColor(mHost->mCanvas->grab().toImage().pixel(200, 150)), QColor(Qt::white));
    }
};

QTEST_MAIN(AlwaysLitTest)
#include "test_always_lit.moc"
